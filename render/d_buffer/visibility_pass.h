// D-buffer step 7: visibility of an image's surface points by the D-buffer. Also holds what steps 1, 3 and 8
// know of the image.
//
// In: surface points (once per camera), the filled D-buffer, a light. Out: V per pixel. "Umbra and penumbra
// volumes" (2004), section 4. The image is shaded in two passes, since software rasterizers run both sides of
// every branch: d_buffer_select.frag.glsl decides pixels where no entry applies and marks the others by
// depth, d_buffer_visibility.frag.glsl evaluates those.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "render/d_buffer/center_rays.h"
#include "render/d_buffer/d_buffer.h"
#include "render/d_buffer/entries/receiver_grid.h"
#include "render/d_buffer/entries/tiles.h"
#include "render/d_buffer/layers.h"
#include "render/d_buffer/resampler.h"
#include "render/d_buffer/seen_boundary.h"
#include "render/d_buffer/view/receivers_in_light.h"
#include "render/d_buffer/view/view.h"
#include "render/receivers/receiver_middle.h"

namespace penumbra::detail {

/// Pixels whose entries contradict what is known of the light's center, ascending. `uses`: two a pixel. Cost
/// O(pixels).
std::vector<std::uint32_t> uncertain_pixels(std::span<const EntryUse> uses);

/// The entries that step 6 has drawn, and their records in a buffer texture.
struct DrawnEntries {
  const EntryGeometry& geometry;
  GLuint records;
};

class VisibilityPass {
 public:
  explicit VisibilityPass(const gl::Functions& gl);
  ~VisibilityPass();
  /// Copies the surface points. `first_face`: as from first_faces (casters.h). `rays` must outlive this.
  void set_surface(const Receivers& surface, std::vector<std::uint32_t> first_face, const RayScene& rays);
  bool has_surface() const { return width_ > 0; }
  /// The copy.
  Receivers surface() const;
  const ReceiverMiddle& middle() const { return middle_; }
  int automatic_size() const { return d_buffer_size_for(width_, height_); }

  /// Step 1: which receivers see the light's center, by one ray each.
  void trace_center(const CircularLight& light);
  /// Step 3: receivers as the view's shaders see them, and uploads them. With trace_center before it, finds
  /// the visibility where no entry applies: by the center and the horizon.
  void place_receivers(const ReceiversInLight& receivers, const DBufferView& view);
  /// Step 3: which receivers read what of the only target. Call trace_center and place_receivers before.
  ReceiverGrid receiver_grid(const DBufferView& view, int size) const;

  /// The parts of the image that shade has to visit, as from entries/tiles.h: all of it where the visibility
  /// without entries is not known yet. `grid`: as from receiver_grid, or everywhere. Does not use OpenGL.
  std::vector<glm::vec2> tiles(const DBufferView& view, const ReceiverGrid& grid,
                               const EntryGeometry& geometry, const DBufferOptions& options) const;
  /// Visibility of every pixel. `tiles`: as from this class. The framebuffer that is bound is used; its
  /// attachments are replaced.
  std::vector<float> shade(const CircularLight& light, const DBufferView& view,
                           const std::vector<glm::vec2>& tiles, const DBufferLayers& layers,
                           const DrawnEntries& entries, const DBufferOptions& options);
  /// How many pixels of the last image were sampled by rays (EntryCheck::kRays).
  std::size_t resampled() const { return resampled_; }

 private:
  struct Programs;
  ImageReceivers receivers() const;
  void find_open();
  template <class T>
  void upload(const gl::Object& texture, GLenum format, const std::vector<T>& texels) const;
  Programs& programs(const DBufferView& view, const DBufferOptions& options);
  void upload_tiles(const std::vector<glm::vec2>& tiles);
  void test_center_by_depth(const Programs& programs, const DBufferView& view, const DBufferLayers& layers,
                            GLuint records);
  void shade_pixels(const gl::Program& program, const DBufferView& view, const DBufferLayers& layers,
                    GLuint records) const;
  void begin_uses() const;
  std::vector<EntryUse> read_uses() const;
  void resample(const CircularLight& light, const EntryGeometry& geometry, std::vector<float>& visibility);
  RaySample sample_of(std::uint32_t pixel, std::span<const SeenPoints> seen, std::span<const EntryUse> uses,
                      const EntryGeometry& geometry, float by_entries) const;
  void bind_textures(const gl::Program& program, const DBufferLayers& layers, GLuint records) const;

  const gl::Functions& gl_;
  int width_ = 0, height_ = 0;
  std::size_t resampled_ = 0;
  std::unique_ptr<gl::Object> surface_position_, surface_plane_, center_seen_, visibility_texture_,
      use_texture_, mark_texture_;
  std::unique_ptr<CenterRays> center_rays_;
  /// What the caller's arrays held.
  std::vector<Vec3> points_, normals_;
  std::vector<std::int32_t> objects_;
  std::vector<std::uint32_t> faces_, first_face_;
  ReceiverMiddle middle_;
  /// Under this frame's light.
  ReceiverTexels texels_;
  /// Of each pixel: 1 where it sees the light's center, else 0; the disk's fraction above its horizon; V
  /// without entries.
  std::vector<float> seen_, open_, without_entries_;
  std::vector<std::uint32_t> isolated_;
  Resampler resampler_;
  gl::Object tile_array_, tile_buffer_;
  GLsizei tile_vertices_ = 0;
  /// One set for each combination of options that occurred.
  std::vector<std::unique_ptr<Programs>> programs_;
};

}  // namespace penumbra::detail
