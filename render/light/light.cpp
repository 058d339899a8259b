#include "penumbra/render/light/light.h"

#include <array>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <numbers>

#include "penumbra/mesh/error.h"

namespace penumbra {
namespace {

/// For messages.
std::string kind_of(const LightShape& shape) {
  return std::string("a ") + name_of(shape) + (std::holds_alternative<DistantLight>(shape) ? " light" : "");
}

}  // namespace

DiskLight disk_around(const LightShape& shape) {
  if (const auto* disk = std::get_if<DiskLight>(&shape)) return *disk;
  const auto& rectangle = std::get<RectangleLight>(shape);
  return {rectangle.center, rectangle.normal, std::hypot(rectangle.half_extents.x, rectangle.half_extents.y)};
}

double irradiance_per_radiance(const DistantLight& light) {
  if (light.angle_degrees == 0.0) return 1.0;
  const double sine = std::sin(0.5 * glm::radians(light.angle_degrees));
  return std::numbers::pi * sine * sine;
}

bool is_point(const LightShape& shape) {
  if (const auto* distant = std::get_if<DistantLight>(&shape)) return distant->angle_degrees == 0.0;
  const auto* disk = std::get_if<DiskLight>(&shape);
  return disk && disk->radius == 0.0;
}

const char* name_of(const LightShape& shape) {
  return std::array{"disk", "rectangle", "distant"}.at(shape.index());
}

const DiskLight& require_disk(const LightShape& shape, const std::string& who) {
  if (const auto* disk = std::get_if<DiskLight>(&shape)) return *disk;
  throw UsageError(who + " needs a disk light and this one is " + kind_of(shape) +
                   "; give it \"shape\": \"disk\" and a radius");
}

CircularLight require_circular(const LightShape& shape, const std::string& who) {
  if (const auto* distant = std::get_if<DistantLight>(&shape)) return *distant;
  if (const auto* disk = std::get_if<DiskLight>(&shape)) return *disk;
  throw UsageError(who + " needs a disk light, near or distant, and this one is " + kind_of(shape) +
                   "; give it \"shape\": \"disk\" and a radius");
}

}  // namespace penumbra
