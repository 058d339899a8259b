// The image's side of the D-buffer: receivers, whether each sees the light's center, and the visibility
// shader.
#pragma once

#include <memory>
#include <vector>

#include "render/d_buffer/center_rays.h"
#include "render/d_buffer/d_buffer.h"
#include "render/d_buffer/entries/receiver_grid.h"
#include "render/d_buffer/entries/targets.h"
#include "render/d_buffer/entries/tiles.h"
#include "render/d_buffer/layers.h"
#include "render/d_buffer/visibility_steps.h"

namespace penumbra::detail {

/// What the shaders know of the light and of the D-buffer.
struct DBufferView {
  const std::vector<Target>& targets;
  glm::mat3 axes;  ///< scene frame → light's frame
  glm::vec3 offset;
  double radius;  ///< of the disk, in the light's frame
};

class DBufferShading {
 public:
  explicit DBufferShading(const gl::Functions& gl);
  ~DBufferShading();
  /// `positions` are those of the surface buffer in the scene's frame, the fourth number 1 + the face's
  /// number over all objects, 0 where nothing is seen. Uploads them. `rays` must outlive this.
  void set_surface(const Receivers& surface, std::vector<glm::vec4> positions, const RayScene& rays);
  bool has_surface() const { return width_ > 0; }
  int automatic_size() const { return d_buffer_size_for(width_, height_); }

  /// One ray a pixel to the light's center; `seen` and the visibility where no entry applies come of it.
  void trace_center(const DiskLight& light);
  /// Who will read the only target, after trace_center.
  ReceiverGrid receiver_grid(const DBufferView& view, int size) const;

  /// The parts of the image that shading visits, as from d_buffer_tiles.h: all, where the visibility without
  /// entries is not known yet. `grid` says who reads what, as from receiver_grid, or is everywhere. Makes no
  /// use of OpenGL.
  std::vector<glm::vec2> tiles(const DBufferView& view, const ReceiverGrid& grid,
                               const EntryGeometry& geometry, const DBufferOptions& options) const;
  /// Visibility of every pixel. The framebuffer that is bound is used and its attachments are replaced.
  /// `records` is the buffer texture of facets.
  std::vector<float> shade(const DiskLight& light, const DBufferView& view,
                           const std::vector<glm::vec2>& tiles, const DBufferLayers& layers, GLuint records,
                           const DBufferOptions& options);
  /// Pixels of the last image whose visibility was asked of rays (EntryCheck::kRays).
  std::size_t sampled() const { return sampled_; }

 private:
  struct Programs;
  ImageReceivers receivers(const DBufferView& view) const;
  Programs& programs(const DBufferView& view, const DBufferOptions& options);
  void upload_tiles(const std::vector<glm::vec2>& tiles);
  void test_center_by_depth(const Programs& programs, const DBufferView& view, const DBufferLayers& layers,
                            GLuint records);
  void shade_pixels(const gl::Program& program, const DBufferView& view, const DBufferLayers& layers,
                    GLuint records) const;
  void check(const DiskLight& light, std::span<const std::uint32_t> doubtful, std::vector<float>& visibility);
  void bind_textures(const gl::Program& program, const DBufferLayers& layers, GLuint records) const;

  const gl::Functions& gl_;
  int width_ = 0, height_ = 0;
  std::size_t sampled_ = 0;
  std::unique_ptr<gl::Object> surface_position_, surface_normal_, center_seen_, visibility_texture_,
      mark_texture_;
  std::unique_ptr<CenterRays> center_rays_;
  std::vector<glm::vec4> positions_, normals_;
  std::vector<float> seen_, open_, without_entries_;
  std::vector<std::uint32_t> lonely_;  ///< pixels, see lonely_pixels
  VisibilitySteps steps_;
  gl::Object tile_array_, tile_buffer_;
  GLsizei tile_vertices_ = 0;
  std::vector<std::unique_ptr<Programs>> programs_;  ///< made when needed
};

}  // namespace penumbra::detail
