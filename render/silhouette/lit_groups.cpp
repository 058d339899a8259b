#include "render/silhouette/lit_groups.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "render/silhouette/collect/shaft.h"

namespace penumbra::detail {
namespace {

/// Accuracy. Far above the rounding of what is compared.
constexpr double kMargin = 0x1p-30;

/// Half the size of a turned box of half size `half`.
Vec3 turned(const UnitLight& light, const Vec3& half) {
  return glm::abs(light.direction({half.x, 0.0, 0.0})) + glm::abs(light.direction({0.0, half.y, 0.0})) +
         glm::abs(light.direction({0.0, 0.0, half.z}));
}

}  // namespace

LitGroups::LitGroups(const BoxedGroups& groups, const CasterBoxes& boxes, const LitScene& lit, bool horizon)
    : groups_(groups), lit_(lit), horizon_(horizon) {
  if (lit.light.is_projective()) return;
  for (std::size_t i = 0; i < lit.boxes.size(); ++i) {
    if (!lit.casts(i)) continue;
    Caster& caster = casters_.emplace_back();
    caster.box = lit.boxes[i];
    for (const Bounds& part : boxes.of(i)) caster.parts.push_back(to_frame(part));
  }
}

LitGroups::Box LitGroups::to_frame(const Bounds& world) const {
  return {
      lit_.light.point(world.center()),
      turned(lit_.light, 0.5 * (world.high - world.low)) * lit_.light.per_radius() + kMargin * lit_.extent};
}

bool LitGroups::is_lit(std::size_t group) const {
  const ReceiverBox& box = groups_.boxes[group];
  if (lit_.light.is_projective() || box.count == 0) return false;
  const Box points = to_frame(box.points);
  if (!(points.low().z > 0.0)) return false;
  if (horizon_ && !has_disk_above(box, points)) return false;
  const Shaft shaft(Bounds{points.low(), points.high()}, lit_.extent);
  return std::ranges::all_of(casters_, [&](const Caster& caster) {
    return shaft.misses(caster.box.low, caster.box.high) ||
           std::ranges::all_of(caster.parts,
                               [&](const Box& part) { return shaft.misses(part.low(), part.high()); });
  });
}

/// With n = m + d and x = y + e, m and y the middles of both boxes: the center's height -n·x over the tangent
/// plane is at least -m·y - |m|·|e| - |d|·(|y| + |e|), by components, and the plane falls across the disk by
/// at most |n_xy|.
bool LitGroups::has_disk_above(const ReceiverBox& box, const Box& points) const {
  const Vec3 normal = lit_.light.direction(box.normals.center());
  const Vec3 beside = turned(lit_.light, 0.5 * (box.normals.high - box.normals.low));
  const double least = -glm::dot(normal, points.middle) - glm::dot(glm::abs(normal), points.half) -
                       glm::dot(beside, glm::abs(points.middle) + points.half);
  const double fall = std::hypot(std::abs(normal.x) + beside.x, std::abs(normal.y) + beside.y);
  return least > fall + kMargin * lit_.extent;
}

}  // namespace penumbra::detail
