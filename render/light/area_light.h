// A light as an area in a frame of its own, for what takes a disk, a rectangle or a distant light.
#pragma once

#include <glm/vec2.hpp>

#include "penumbra/render/light/light.h"

namespace penumbra {

/// All points center + a·u + b·v with |a| ≤ half.x and |b| ≤ half.y, or the disk of radius half.x = half.y.
/// Lengths in scene units; u and v are the disk's own (light_frame) or run along the rectangle's sides.
///
/// A distant light is the disk of radius tan(angle/2) at unit distance that each receiver has before itself:
/// the same points are the directions from any receiver towards the light. All that depends on directions
/// alone is right for it: area fractions and the irradiance factor.
struct AreaLight {
  LightFrame axes;
  /// Of a distant light -axes.w, the direction towards it.
  Vec3 center{0.0};
  /// Of a distant light tan(angle/2), twice.
  glm::dvec2 half{0.0};
  bool disk = true;
  bool distant = false;

  /// In the light's frame: (u, v, distance in front of the light's plane). Of a distant light (0, 0, 1),
  /// wherever the point is.
  Vec3 to_light(const Vec3& world) const;
  Vec3 direction_to_light(const Vec3& world) const;
  /// From a receiver to the light's center; of a distant light the unit vector towards it.
  Vec3 from_receiver(const Vec3& world) const { return distant ? center : center - world; }
  /// True on the light's plane and behind it. Nothing is behind a distant light.
  bool is_behind(const Vec3& world) const { return to_light(world).z <= 0.0; }
};
AreaLight area_light(const LightShape& shape);

}  // namespace penumbra
