// The draw calls that fill a D-buffer: occluders, then entries.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "render/d_buffer/caster_filter.h"
#include "render/d_buffer/d_buffer.h"
#include "render/d_buffer/entries/geometry.h"
#include "render/d_buffer/entries/targets.h"
#include "render/d_buffer/layers.h"

namespace penumbra::detail {

class DBufferPasses {
 public:
  explicit DBufferPasses(const gl::Functions& gl);
  /// Casters in a frame of the scene; once.
  void upload_casters(std::vector<glm::vec3> points, std::vector<std::uint32_t> indices,
                      std::vector<CasterRange> casters);
  /// One flag a caster: those that hide nothing are not drawn.
  void set_idle(const std::vector<bool>& idle);
  void upload_entries(const EntryGeometry& geometry);
  /// Fills `layers` for the light given by its axes and offset (scene frame → light's frame). Where rays tell
  /// which receivers see the light's center, only what those that do not will read.
  void draw_occluders(const std::vector<Target>& targets, const glm::mat3& axes, const glm::vec3& offset,
                      const ReceiverGrid& receivers, const DBufferLayers& layers,
                      const DBufferOptions& options);
  void draw_entries(const std::vector<Target>& targets, const DBufferLayers& layers,
                    const DBufferOptions& options);
  GLuint records() const { return record_texture_; }

 private:
  /// The surface that entries are compared with, and on which side of it they have to lie.
  enum class Against { kNothing, kBeforeFirst, kBeforeLast, kBehindLast };
  struct Entries {
    const gl::Object& vertices;
    std::size_t count;
  };
  void draw_casters(const Target& target, const glm::mat3& axes, const glm::vec3& offset);
  void draw_read_casters(const Target& target, const glm::mat3& axes, const glm::vec3& offset,
                         const ReceiverGrid& receivers);
  void draw_kind(const std::vector<Target>& targets, const DBufferLayers& layers, EntryKind kind,
                 const Entries& entries, Against against, const DBufferOptions& options);
  void draw_layer(const std::vector<Target>& targets, const DBufferLayers& layers, EntryKind kind,
                  bool second, const Entries& entries, Against against, const DBufferOptions& options);
  const gl::Program& entry_program(int surface, bool peel);
  void bind_filter(const gl::Program& program, const Layers& surface, const Layer& first) const;
  void set_target(const gl::Program& program, const Target& target) const;
  void attach(const Layer& layer, int index) const;
  void bind(int unit, GLenum kind, GLuint texture) const;

  const gl::Functions& gl_;
  gl::Program occluder_program_;
  std::unique_ptr<gl::Program> entry_programs_[3]
                                              [2];  ///< by SURFACE and PEEL of the shader, made when needed
  gl::Object caster_points_, caster_indices_, read_indices_, caster_array_, penumbra_vertices_,
      umbra_vertices_, entry_array_, record_buffer_, record_texture_;
  std::vector<glm::vec3> points_;
  std::vector<std::uint32_t> indices_;
  std::vector<CasterRange> casters_;
  std::size_t penumbra_count_ = 0, umbra_count_ = 0;
};

}  // namespace penumbra::detail
