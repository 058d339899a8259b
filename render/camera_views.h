// What a camera sees of objects that stay as they are, kept from picture to picture: while the camera and the
// size stay, no ray is sent again, whatever the lights do.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "render/rays/camera_rays.h"

namespace penumbra::detail {

/// Not for several threads at once.
class CameraViews {
 public:
  /// The surface buffer through that point of each pixel: the one of an earlier call where the scene's
  /// camera, the size and the point are the same, bit for bit what make_surface_buffer gives. The objects
  /// must be those of the first call. With another camera or size all that was kept is dropped. The first of
  /// a camera stays until then, and others as far as 256 MiB reach; what is not kept stays until the next
  /// call. Throws what make_surface_buffer does.
  const SurfaceBuffer& see(const Scene& scene, const RayScene& rays, int width, int height,
                           const PointInPixel& at = {}, const Progress& progress = {});
  /// The last buffer of pixels' centers; null where there is none.
  const SurfaceBuffer* last() const;
  /// The next calls send their rays again.
  void forget();
  /// How many rays have been sent so far.
  std::uint64_t rays_sent() const { return rays_sent_; }

 private:
  struct View {
    PointInPixel at;
    SurfaceBuffer surface;
  };
  std::size_t most() const;

  Camera camera_;
  int width_ = 0, height_ = 0;
  std::vector<std::unique_ptr<View>> views_;
  /// Beyond what is kept.
  std::unique_ptr<View> passing_;
  /// The memory of one that was dropped.
  SurfaceBuffer spare_;
  std::uint64_t rays_sent_ = 0;
};

}  // namespace penumbra::detail
