#include "penumbra/render/light/light.h"

#include <cmath>

#include "penumbra/mesh/error.h"

namespace penumbra {

DiskLight disk_around(const LightShape& shape) {
  if (const auto* disk = std::get_if<DiskLight>(&shape)) return *disk;
  const auto& rectangle = std::get<RectangleLight>(shape);
  return {rectangle.center, rectangle.normal, std::hypot(rectangle.half_extents.x, rectangle.half_extents.y)};
}

bool is_point(const LightShape& shape) {
  const auto* disk = std::get_if<DiskLight>(&shape);
  return disk && disk->radius == 0.0;
}

const char* name_of(const LightShape& shape) {
  return std::holds_alternative<DiskLight>(shape) ? "disk" : "rectangle";
}

const DiskLight& require_disk(const LightShape& shape, const std::string& who) {
  if (const auto* disk = std::get_if<DiskLight>(&shape)) return *disk;
  throw UsageError(
      who + " needs a disk light and this one is a rectangle; give it \"shape\": \"disk\" and a radius");
}

}  // namespace penumbra
