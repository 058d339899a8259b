// Lights: a disk, near or distant, or a rectangle, each with a name and a radiance.
#pragma once

#include <glm/vec2.hpp>
#include <string>
#include <variant>

#include "penumbra/volumes/disk_light.h"

namespace penumbra {

/// A flat rectangle that shines on the side of its normal. Its sides run along `tangent` and along
/// normal × tangent.
struct RectangleLight {
  /// Scene units.
  Vec3 center{0.0};
  /// Of any length but 0.
  Vec3 normal{0.0, -1.0, 0.0};
  /// Of any length, not parallel to the normal; only its part in the light's plane counts.
  Vec3 tangent{1.0, 0.0, 0.0};
  /// Half the sides' lengths along the tangent and across it, scene units, greater than 0.
  glm::dvec2 half_extents{0.5};

  /// Number by number.
  bool operator==(const RectangleLight&) const = default;
};

using LightShape = std::variant<DiskLight, RectangleLight, DistantLight>;

struct Light {
  /// Of letters, digits, '-' and '_', at most 200; unlike that of any other light of a scene. May be empty
  /// where a scene has one light.
  std::string name{};
  LightShape shape{};
  /// Linear RGB, W/(m² sr) if a scene unit is a meter. Of a disk of radius 0: its intensity, W/sr; of a
  /// distant light of angle 0: the irradiance of a surface that faces it, W/m².
  Vec3 radiance{10.0};

  bool operator==(const Light&) const = default;
};

/// The smallest disk that holds the light; the disk itself where the light is one. Not for distant lights.
DiskLight disk_around(const LightShape& shape);

/// The irradiance of a surface that faces the light and sees all of it, for a radiance of 1: π sin²(angle/2),
/// the solid angle of the disk weighted by the cosine. 1 at angle 0, where `radiance` is that irradiance.
double irradiance_per_radiance(const DistantLight& light);

/// True where the light is a disk of radius 0, or a distant light of angle 0.
bool is_point(const LightShape& shape);

/// "disk", "rectangle" or "distant".
const char* name_of(const LightShape& shape);

/// The disk. Throws UsageError that begins with `who` where the light is no disk.
const DiskLight& require_disk(const LightShape& shape, const std::string& who);

/// The disk, near or distant. Throws UsageError that begins with `who` where the light is a rectangle.
CircularLight require_circular(const LightShape& shape, const std::string& who);

}  // namespace penumbra
