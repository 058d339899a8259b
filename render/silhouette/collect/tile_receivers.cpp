#include "render/silhouette/collect/tile_receivers.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "render/support/vector_clones.h"

namespace penumbra::detail {
namespace {

/// Accuracy. A horizon that cuts the disk is raised by this much, light radii. What lies in a receiver's
/// tangent plane, such as the edges of a face that it meets at a right angle, is then below it for certain,
/// and not on either side by rounding. Visibility is in float, which has fewer digits. Held by the test
/// ExactReceivers.
constexpr double kRaised = 0x1p-30;

}  // namespace

ReceiverSource::ReceiverSource(const Receivers& receivers, const ReceiverGroups& groups,
                               const UnitLight& light, bool horizon, const DecidedReceivers& out)
    : receivers_(receivers),
      groups_(groups),
      light_(light),
      horizon_(horizon && receivers.has_normals()),
      out_(out) {}

/// Inlined: a call would take two of a receiver's few nanoseconds.
PENUMBRA_INLINE ReceiverSource::Kind ReceiverSource::add(std::uint32_t index,
                                                         std::vector<TileReceiver>& receivers) const {
  if (!receivers_.is_present(index)) return Kind::kAbsent;
  const Vec3& point = receivers_.points[index];
  const Vec3 normal = receivers_.has_normals() ? receivers_.normals[index] : Vec3(0.0);
  const Vec3 x = light_.point(point);
  if (!(x.z > 0.0)) {
    out_.visibility[index] = 0.0f;
    if (!out_.region.empty()) out_.region[index] = 2;
    return Kind::kBehindLight;
  }
  const Vec3 n = light_.plane_normal(point, normal);
  // The center's height over the tangent plane, and how far the plane falls or rises across the disk.
  const double center = -glm::dot(n, x), fall2 = n.x * n.x + n.y * n.y;
  const bool cuts = horizon_ && center * center < fall2;
  if (horizon_ && !cuts && !(center > 0.0)) {
    out_.visibility[index] = 0.0f;
    return Kind::kBelowHorizon;
  }
  Chord horizon = no_horizon();
  if (cuts) {
    horizon = chord_of_plane(n, x, 1.0);
    horizon.delta -= kRaised;
  }
  // In place, member by member: a receiver made elsewhere and copied is read in wider pieces than it was
  // written in, for which the processor waits.
  TileReceiver& r = receivers.emplace_back();
  r.x = x;
  r.normal = n;
  r.horizon = horizon;
  r.horizon_cuts = cuts;
  r.index = index;
  return Kind::kReceiver;
}

std::size_t ReceiverSource::collect(std::size_t group, std::vector<TileReceiver>& receivers) const {
  receivers.clear();
  std::size_t behind = 0;
  groups_.for_each(group, [&](std::uint32_t index) {
    const Kind kind = add(index, receivers);
    behind += kind == Kind::kBehindLight ? 1 : 0;
  });
  return behind;
}

void ReceiverSource::light_up(std::size_t group) const {
  groups_.for_each(group, [&](std::uint32_t index) {
    if (!receivers_.is_present(index)) return;
    out_.visibility[index] = 1.0f;
    out_.region[index] = 0;
  });
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
