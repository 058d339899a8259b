#include "apps/viewer/handles/handled_light.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "mesh/vectors.h"

namespace penumbra::viewer {
namespace {

DiskLight disk_of(const DistantLight& light, const Vec3& middle, double distance) {
  const Vec3 direction = detail::unit(light.direction);
  return {middle - distance * direction, direction, distance * CircularLight(light).radius};
}

RectangleLight changed(RectangleLight rectangle, const DiskLight& before, const DiskLight& after) {
  if (after.radius > 0.0 && after.radius != before.radius)
    rectangle.half_extents *= after.radius / before.radius;
  rectangle.center = after.center;
  rectangle.normal = after.normal;
  return rectangle;
}

// Numbers that were not changed are kept to the bit.
DistantLight changed(DistantLight light, const HandledLight& before, const HandledLight& after) {
  if (after.disk.normal != before.disk.normal) light.direction = after.disk.normal;
  if (after.disk.radius != before.disk.radius) {
    const double distance = glm::length(before.disk.center - *before.middle);
    light.angle_degrees = glm::degrees(2.0 * std::atan(after.disk.radius / distance));
  }
  return light;
}

}  // namespace

HandledLight handled(const LightShape& shape, const Bounds& casters) {
  const auto* distant = std::get_if<DistantLight>(&shape);
  if (!distant) return disk_around(shape);
  const Vec3 middle = casters.empty() ? Vec3(0.0) : casters.center();
  const double radius = casters.empty() ? 0.0 : casters.radius();
  return {disk_of(*distant, middle, radius > 0.0 ? 2.0 * radius : 1.0), middle};
}

LightShape changed(const LightShape& shape, const HandledLight& before, const HandledLight& after) {
  if (const auto* distant = std::get_if<DistantLight>(&shape)) return changed(*distant, before, after);
  if (const auto* rectangle = std::get_if<RectangleLight>(&shape))
    return changed(*rectangle, before.disk, after.disk);
  return after.disk;
}

Heading heading_of(const DistantLight& light) {
  const Vec3 towards = -detail::unit(light.direction);
  return {.azimuth =
              std::hypot(towards.x, towards.z) > 1e-9 ? glm::degrees(std::atan2(towards.x, towards.z)) : 0.0,
          .elevation = glm::degrees(std::asin(std::clamp(towards.y, -1.0, 1.0)))};
}

Vec3 direction_from(const Heading& heading) {
  const double azimuth = glm::radians(heading.azimuth), elevation = glm::radians(heading.elevation);
  const double level = std::cos(elevation);
  return -Vec3(level * std::sin(azimuth), std::sin(elevation), level * std::cos(azimuth));
}

}  // namespace penumbra::viewer
