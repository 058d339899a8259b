#include "render/soft_shadow_volumes/light_patches.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace penumbra::detail {
namespace {

Polygon polygon_in_disk() {
  constexpr int kCorners = 64;
  Polygon out;
  for (int k = 0; k < kCorners; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / kCorners;
    out.emplace_back(std::cos(angle), std::sin(angle));
  }
  return out;
}

Polygon common_part(Polygon polygon, const Polygon& with) {
  for (std::size_t i = 0; i < with.size(); ++i) {
    Polygon clipped;
    clip(polygon, left_of(with[i], with[(i + 1) % with.size()]), clipped);
    polygon = std::move(clipped);
  }
  return polygon;
}

}  // namespace

LightPatches::LightPatches(const AreaLight& light, const UnitLight& unit, int splits)
    : disk(light.disk), whole_disk(light.disk && splits == 1) {
  constexpr double kLeastArea = 1e-9;  // of a cell's part of the disk
  const Vec3 across = unit.offset_on_disk({1.0, 0.0}), up = unit.offset_on_disk({0.0, 1.0});
  const double radius2 = glm::dot(across, across);
  const auto on_disk = [&](const Vec3& v) {
    return glm::dvec2(glm::dot(v, across), glm::dot(v, up)) / radius2;
  };
  const glm::dvec2 u = on_disk(light.axes.u * light.half.x), v = on_disk(light.axes.v * light.half.y);
  const bool turns = cross(u, v) < 0.0;
  const auto at = [&](int i, int k) {
    const double a = 2.0 * i / splits - 1.0, b = 2.0 * k / splits - 1.0;
    return a * u + (turns ? -b : b) * v;
  };
  for (int k = 0; k < splits; ++k)
    for (int i = 0; i < splits; ++i) {
      LightPatch patch;
      patch.outline = {at(i, k), at(i + 1, k), at(i + 1, k + 1), at(i, k + 1)};
      patch.inner = disk ? common_part(polygon_in_disk(), patch.outline) : patch.outline;
      if (area_of(patch.inner) < kLeastArea) continue;
      if (!whole_disk) patch.center = centroid_of(patch.inner);
      total += area(patch.outline);
      patches.push_back(std::move(patch));
    }
}

}  // namespace penumbra::detail
