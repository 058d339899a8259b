// Silhouette method: the frame of the light. All geometry of the method is done in it.
//
// In: a disk light. Out: the map from the world to the frame in which the light is the unit disk in z = 0 and
// shines towards +z,
//   p → ((p - center)·u, (p - center)·v, (p - center)·w) / radius.
// So lengths in this frame are in light radii.
//
// u and v are the axes of `light_frame` turned about w. Those axes often run along walls, bars and treads,
// and rows of scanlines (areas/rows.h) are least exact for edges that run along them.
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "penumbra/volumes/disk_light.h"

namespace penumbra::detail {

/// Requires a radius greater than 0.
class UnitLight {
 public:
  explicit UnitLight(const DiskLight& light);
  const DiskLight& disk() const { return disk_; }
  /// A point of the world in the light's frame.
  Vec3 point(const Vec3& world) const { return direction(world - center_) * per_radius_; }
  /// A vector of the world, rotated but not scaled.
  Vec3 direction(const Vec3& world) const {
    return {glm::dot(world, axes_.u), glm::dot(world, axes_.v), glm::dot(world, axes_.w)};
  }
  /// The inverse of `direction`.
  Vec3 world_direction(const Vec3& d) const { return d.x * axes_.u + d.y * axes_.v + d.z * axes_.w; }
  const Vec3& normal() const { return axes_.w; }
  /// A point of the unit disk in the world.
  Vec3 world_on_disk(const glm::dvec2& p) const { return center_ + p.x * across_ + p.y * up_; }
  /// Light radii in one scene unit.
  double per_radius() const { return per_radius_; }

 private:
  DiskLight disk_;
  LightFrame axes_;
  Vec3 center_;
  /// They span the disk; their length is its radius.
  Vec3 across_, up_;
  double per_radius_;
};

}  // namespace penumbra::detail
