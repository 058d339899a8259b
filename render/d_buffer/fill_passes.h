// D-buffer steps 5 and 6: the draw calls that fill the D-buffer, occluders first, then entries.
//
// "Umbra and penumbra volumes" (2004), sections 3.1 to 3.3. Into every target go the first surface (face and
// depth), the depth of the last surface that faces the light's center, penumbra entries in front of the first
// surface, umbra entries in front of the last surface, and umbra entries behind it. An umbra begins anew
// behind every surface that faces the center, so a receiver between two surfaces reads other umbra entries
// than one behind both.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "render/d_buffer/caster_filter.h"
#include "render/d_buffer/d_buffer.h"
#include "render/d_buffer/entries/geometry.h"
#include "render/d_buffer/layers.h"
#include "render/d_buffer/view/view.h"

namespace penumbra::detail {

class FillPasses {
 public:
  explicit FillPasses(const gl::Functions& gl);
  /// Once.
  void upload_casters(CasterTriangles casters);
  /// What changes from frame to frame: which casters cannot occlude, which show only fronts.
  CasterTriangles& casters() { return casters_; }
  /// Every frame, before draw_occluders: as from drawn_points.
  void upload_points(std::vector<glm::vec4> points);
  void upload_entries(const EntryGeometry& geometry);
  /// Fills the first and the last surface of `layers`. The first is drawn only for options that read it; of
  /// the last only what `receivers` read. The framebuffer that is bound is used.
  void draw_occluders(const DBufferView& view, const ReceiverGrid& receivers, const DBufferLayers& layers,
                      const DBufferOptions& options);
  /// Fills the entries of `layers`, after draw_occluders and upload_entries.
  void draw_entries(const DBufferView& view, const DBufferLayers& layers, const DBufferOptions& options);
  /// The buffer texture of EntryGeometry::records.
  GLuint records() const { return record_texture_; }

 private:
  /// The surface that entries are compared with, and on which side of it they have to lie.
  enum class Against { kNothing, kBeforeFirst, kBeforeLast, kBehindLast };
  struct Entries {
    const gl::Object& vertices;
    std::size_t count;
  };
  void draw_casters(const Target& target, const DBufferView& view);
  void draw_read_casters(const Target& target, const DBufferView& view, const ReceiverGrid& receivers);
  void draw_kind(const DBufferView& view, const DBufferLayers& layers, EntryKind kind, const Entries& entries,
                 Against against, const DBufferOptions& options);
  void draw_layer(const DBufferView& view, const DBufferLayers& layers, EntryKind kind, bool second,
                  const Entries& entries, Against against, const DBufferOptions& options);
  const gl::Program& entry_program(int surface, bool peel);
  void bind_filter(const gl::Program& program, const Layers& surface, const Layer& first) const;
  void set_target(const gl::Program& program, const Target& target, const DBufferView& view) const;
  void attach(const Layer& layer, int index) const;
  void bind(int unit, GLenum kind, GLuint texture) const;

  const gl::Functions& gl_;
  gl::Program occluder_program_;
  /// By SURFACE and PEEL of d_buffer_entry.frag.glsl, made when needed.
  std::unique_ptr<gl::Program> entry_programs_[3][2];
  gl::Object caster_points_, caster_indices_, read_indices_, caster_array_, penumbra_vertices_,
      umbra_vertices_, entry_array_, record_buffer_, record_texture_;
  CasterTriangles casters_;
  std::vector<glm::vec4> points_;
  std::size_t penumbra_count_ = 0, umbra_count_ = 0;
};

}  // namespace penumbra::detail
