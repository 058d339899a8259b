#include "render/camera_views.h"

#include <algorithm>
#include <utility>

namespace penumbra::detail {
namespace {

/// Memory that buffers beyond the first may take.
constexpr std::size_t kMostBytes = std::size_t{256} << 20;

constexpr std::size_t kBytesOfPixel = 2 * sizeof(Vec3) + sizeof(std::int32_t) + sizeof(std::uint32_t);

bool is_same(const PointInPixel& a, const PointInPixel& b) {
  return a.x == b.x && a.y == b.y;
}

}  // namespace

std::size_t CameraViews::most() const {
  const std::size_t width = static_cast<std::size_t>(std::max(1, width_)),
                    height = static_cast<std::size_t>(std::max(1, height_));
  return 1 + kMostBytes / (kBytesOfPixel * width * height);
}

const SurfaceBuffer& CameraViews::see(const Scene& scene, const RayScene& rays, int width, int height,
                                      const PointInPixel& at, const Progress& progress) {
  if (!(camera_ == scene.camera) || width_ != width || height_ != height) forget();
  camera_ = scene.camera, width_ = width, height_ = height;
  for (const auto& view : views_)
    if (is_same(view->at, at)) return view->surface;
  SurfaceBuffer& memory = views_.size() < most() || !passing_ ? spare_ : passing_->surface;
  auto view = std::make_unique<View>(
      View{at, make_surface_buffer(scene, rays, width, height, at, progress, std::move(memory))});
  rays_sent_ += view->surface.size();
  std::unique_ptr<View>& place = views_.size() < most() ? views_.emplace_back() : passing_;
  place = std::move(view);
  return place->surface;
}

const SurfaceBuffer* CameraViews::last() const {
  const auto center = std::ranges::find_if(views_, [](const auto& view) { return view->at.is_center(); });
  return center == views_.end() ? nullptr : &(*center)->surface;
}

void CameraViews::forget() {
  if (!views_.empty()) spare_ = std::move(views_.front()->surface);
  views_.clear();
  passing_.reset();
}

}  // namespace penumbra::detail
