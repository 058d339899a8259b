#include "render/silhouette/edges/point_groups.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

#include "mesh/vectors.h"

namespace penumbra::detail {
namespace {

// Accuracy.
/// What rounding may add to a box, over the largest coordinate. Held by the test PointGroups.
constexpr double kRounding = 0x1p-46;

// Speed.
/// Points a group. More make each group that reaches a side of the box dearer, fewer make more groups. Seen
/// in the benchmark `silhouette`, stage band.
constexpr std::size_t kGroup = 256;

std::span<const Vec3> group(std::span<const Vec3> points, std::size_t i) {
  return points.subspan(i * kGroup, std::min(kGroup, points.size() - i * kGroup));
}

/// The same in a projective frame, where the image of a box lies between the images of its corners.
Bounds around_corners(const Bounds& world, const UnitLight& light) {
  Bounds out;
  for (int corner = 0; corner < 8; ++corner)
    out.add(light.point({corner & 1 ? world.high.x : world.low.x, corner & 2 ? world.high.y : world.low.y,
                         corner & 4 ? world.high.z : world.low.z}));
  const double grain =
      kRounding * std::max(1.0, std::max(largest_component(out.low), largest_component(out.high)));
  return {out.low - grain, out.high + grain};
}

/// A box in the light's frame around a box of the world.
Bounds around(const Bounds& world, const UnitLight& light) {
  if (light.is_projective()) return around_corners(world, light);
  const Vec3 middle = light.point(world.center()), half = 0.5 * (world.high - world.low);
  const double far = std::max(largest_component(world.low), largest_component(world.high));
  Vec3 reach(kRounding * (largest_component(middle) + light.per_radius() * far));
  for (int k = 0; k < 3; ++k) {
    Vec3 side(0.0);
    side[k] = half[k];
    reach += light.per_radius() * glm::abs(light.direction(side));
  }
  return {middle - reach, middle + reach};
}

void add(const Vec3& p, Bounds& box) {
  box.low = glm::min(box.low, p);
  box.high = glm::max(box.high, p);
}

}  // namespace

PointGroups::PointGroups(std::span<const Vec3> points)
    : points_(points), groups_((points.size() + kGroup - 1) / kGroup) {
  tbb::parallel_for(std::size_t{0}, groups_.size(),
                    [&](std::size_t i) { groups_[i] = bounds_of(group(points_, i)); });
}

Bounds PointGroups::box_in(const UnitLight& light) const {
  Bounds out;
  for (std::size_t i = 0; i < groups_.size(); ++i) add(light.point(group(points_, i).front()), out);
  for (std::size_t i = 0; i < groups_.size(); ++i) {
    const Bounds box = around(groups_[i], light);
    if (glm::all(glm::lessThanEqual(out.low, box.low)) && glm::all(glm::lessThanEqual(box.high, out.high)))
      continue;
    for (const Vec3& p : group(points_, i)) add(light.point(p), out);
  }
  return out;
}

}  // namespace penumbra::detail
