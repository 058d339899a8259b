// Silhouette method: the frame of the light. All geometry of the method is done in it.
//
// In: a circular light. Out: a map from the world to a frame in which the light is the unit disk in z = 0 and
// shines towards +z. Lines and planes stay lines and planes, their sides stay sides, and what lies between a
// receiver and a point of the disk stays between them. So all that the method asks can be asked there.
//
// A near light: moved, turned and scaled,
//   p → ((p - center)·u, (p - center)·v, (p - center)·w) / radius.
// Lengths are in light radii.
//
// A far or a distant light: such coordinates would all be huge and nearly equal. Let o be the middle of what
// is asked about, (p - o) = (a, b, s) along u, v and w, D the distance of o in front of the light's plane, t
// = (o - center)_uv / D, and S a length beyond all s. The frame is projective,
//   p → k ((a, b) - s t) / (S - s),  k (1 + s/D) S / ((1 + S/D)(S - s)),  k = (S + D) / radius.
// Every term has a limit as D grows: k tends to 1/tan(angle/2), t of a distant light is 0. Coordinates have
// as many digits as p - o. At z = 0, where s = -D, the map is that of the near light; its determinant is
// positive, and S - s is positive for all points that are asked about, so that orientation is kept. Lengths
// near o are like light radii: S is some times the size of what is asked about.
//
// u and v are the axes of `light_frame` turned about w. Those axes often run along walls, bars and treads,
// and rows of scanlines (areas/rows.h) are least exact for edges that run along them.
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "penumbra/mesh/triangle_mesh.h"
#include "penumbra/volumes/disk_light.h"

namespace penumbra::detail {

/// Requires a radius greater than 0.
class UnitLight {
 public:
  /// The frame of a near light, or, for a light that is far from these bounds or distant, the projective one
  /// for all points within the bounds (world, scene units).
  UnitLight(const CircularLight& light, const Bounds& asked_about);
  /// The frame of a near light.
  explicit UnitLight(const DiskLight& light) : UnitLight(light, Bounds()) {}
  const CircularLight& light() const { return light_; }
  bool is_projective() const { return projective_; }
  /// A point of the world in the light's frame.
  Vec3 point(const Vec3& world) const {
    const Vec3 d = direction(world - origin_);
    return projective_ ? projected(d) : d * per_radius_;
  }
  /// The unit normal of the plane through a point of the world, which keeps its sides. `normal`: in the
  /// world, unit, or 0, which stays 0.
  Vec3 plane_normal(const Vec3& world, const Vec3& normal) const;
  /// Where a plane of the frame lies in the world: normal·p + offset, p relative to origin(), has the same
  /// sign.
  struct Plane {
    Vec3 normal;
    double offset;
  };
  Plane world_plane(const Vec3& normal, double offset) const;
  /// A vector of the world along u, v, w.
  Vec3 direction(const Vec3& world) const {
    return {glm::dot(world, axes_.u), glm::dot(world, axes_.v), glm::dot(world, axes_.w)};
  }
  /// The inverse of `direction`.
  Vec3 world_direction(const Vec3& d) const { return d.x * axes_.u + d.y * axes_.v + d.z * axes_.w; }
  /// A point of the unit disk, as a vector from its center in the world; of a distant light across the
  /// direction towards it, at unit distance.
  Vec3 offset_on_disk(const glm::dvec2& p) const { return p.x * across_ + p.y * up_; }
  /// The disk's center for a near light, else the middle of what is asked about.
  const Vec3& origin() const { return origin_; }
  /// Of a near light: light radii in one scene unit.
  double per_radius() const { return per_radius_; }

 private:
  void look_from_afar(const Bounds& asked_about, double reach);
  Vec3 projected(const Vec3& d) const;

  CircularLight light_;
  LightFrame axes_;
  Vec3 origin_;
  /// They span the disk; their length is its radius.
  Vec3 across_, up_;
  double per_radius_;
  // Of the projective frame: k, 1/D, S, t.
  bool projective_ = false;
  double k_ = 0.0, per_distance_ = 0.0, beyond_ = 0.0;
  glm::dvec2 tilt_{0.0};
};

}  // namespace penumbra::detail
