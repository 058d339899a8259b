#include "render/silhouette/tile_receivers.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "render/silhouette/light_rays.h"
#include "render/support/vector_clones.h"

namespace penumbra::detail {

ReceiverSource::ReceiverSource(const Scene& scene, const RayFrame& frame, const SurfaceBuffer& surface,
                               const UnitLight& light, SilhouetteResult& out)
    : scene_(scene), surface_(surface), light_(light), offset_(receiver_offset(frame)), out_(out) {}

/// Inlined: a call would take two of a pixel's few nanoseconds.
PENUMBRA_INLINE ReceiverSource::Kind ReceiverSource::add(std::size_t pixel,
                                                         std::vector<TileReceiver>& receivers) const {
  if (!surface_.hit(pixel)) return Kind::kNoSurface;
  const Vec3& normal = surface_.normal[pixel];
  const Vec3 x = light_.point(surface_.position[pixel] + offset_ * normal);
  // Where the moved point is far in front, so is the point itself; the exact predicate is not asked.
  if (!(x.z > 2.0 * offset_ * light_.per_radius()) && is_behind(scene_.light, surface_.position[pixel])) {
    out_.visibility[pixel] = 0.0f;
    out_.region[pixel] = 2;
    return Kind::kBehindLight;
  }
  if (!(x.z > 0.0)) return Kind::kUndecided;
  const Vec3 n = light_.direction(normal);
  // The center's height over the tangent plane, and how far the plane falls or rises across the disk.
  const double center = -glm::dot(n, x), fall2 = n.x * n.x + n.y * n.y;
  const bool cuts = center * center < fall2;
  if (!cuts && !(center > 0.0)) {
    out_.visibility[pixel] = 0.0f;
    return Kind::kBelowHorizon;
  }
  // In place, member by member: a receiver made elsewhere and copied is read in wider pieces than it was
  // written in, for which the processor waits.
  TileReceiver& r = receivers.emplace_back();
  r.x = x;
  r.normal = n;
  r.horizon = cuts ? chord_of_plane(n, x, 1.0) : no_horizon();
  r.horizon_cuts = cuts;
  r.pixel = static_cast<std::uint32_t>(pixel);
  return Kind::kReceiver;
}

std::size_t ReceiverSource::collect(int column, int row, std::vector<TileReceiver>& receivers,
                                    std::vector<std::uint32_t>& undecided) const {
  receivers.clear();
  std::size_t behind = 0;
  const int x1 = std::min((column + 1) * kTile, surface_.width);
  const int y1 = std::min((row + 1) * kTile, surface_.height);
  for (int y = row * kTile; y < y1; ++y)
    for (int x = column * kTile; x < x1; ++x) {
      const auto pixel = static_cast<std::uint32_t>(y * surface_.width + x);
      const Kind kind = add(pixel, receivers);
      behind += kind == Kind::kBehindLight ? 1 : 0;
      if (kind == Kind::kUndecided) undecided.push_back(pixel);
    }
  return behind;
}

std::size_t halve(std::span<TileReceiver> receivers) {
  Bounds box;
  for (const TileReceiver& r : receivers) box.add(r.x);
  const Vec3 size = box.high - box.low;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
  const std::size_t middle = receivers.size() / 2;
  std::nth_element(receivers.begin(), receivers.begin() + static_cast<std::ptrdiff_t>(middle),
                   receivers.end(),
                   [axis](const TileReceiver& a, const TileReceiver& b) { return a.x[axis] < b.x[axis]; });
  return middle;
}

}  // namespace penumbra::detail
