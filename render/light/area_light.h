// A light as an area in a frame of its own, for what takes a disk or a rectangle.
#pragma once

#include <glm/vec2.hpp>

#include "penumbra/render/light/light.h"

namespace penumbra {

/// All points center + a·u + b·v with |a| ≤ half.x and |b| ≤ half.y, or the disk of radius half.x = half.y.
/// Lengths in scene units; u and v are the disk's own (light_frame) or run along the rectangle's sides.
struct AreaLight {
  LightFrame axes;
  Vec3 center{0.0};
  glm::dvec2 half{0.0};
  bool disk = true;

  /// In the light's frame: (u, v, distance in front of the light's plane).
  Vec3 to_light(const Vec3& world) const;
  Vec3 direction_to_light(const Vec3& world) const;
};
AreaLight area_light(const LightShape& shape);

}  // namespace penumbra
