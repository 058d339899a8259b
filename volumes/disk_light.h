// Circular lights: a flat disk that emits on the side of its normal, or one that is infinitely far away, the
// sun.
#pragma once

#include "penumbra/mesh/types.h"

namespace penumbra {

/// Nothing behind the light's plane casts, and nothing there is lit. Radius 0 is a point light, which shines
/// to one side only as well.
struct DiskLight {
  /// Scene units.
  Vec3 center{0.0};
  /// Where it shines to. Of any length but 0: predicates use it as given, since dividing by its length would
  /// round.
  Vec3 normal{0.0, -1.0, 0.0};
  /// Scene units, at least 0.
  double radius = 0.0;

  bool operator==(const DiskLight&) const = default;
};

/// A disk at infinity, such as the sun: the limit of a disk of radius D·tan(angle/2) at distance D that faces
/// the scene. Everything is in front of it.
struct DistantLight {
  /// In which it shines. Of any length but 0: predicates use it as given.
  Vec3 direction{0.0, -1.0, 0.0};
  /// The angle that the whole disk fills, degrees, at least 0 and below 180.
  double angle_degrees = 0.53;

  bool operator==(const DistantLight&) const = default;
};

/// A circular light at any distance, in homogeneous coordinates: what predicates and volumes work with. The
/// point (center, weight) is the disk's center where weight is 1, and a direction where it is 0.
struct CircularLight {
  /// The disk's center; of a distant light the way towards it, -direction.
  Vec3 center;
  /// 1, or 0 for a distant light.
  double weight;
  /// Where it shines to, of any length but 0.
  Vec3 normal;
  /// Scene units; of a distant light tan(angle/2), the radius at unit distance. NaN where the angle is
  /// outside its domain.
  double radius;

  // Implicit: wherever a circular light is wanted either kind will do, and {center, normal, radius} of a disk
  // too.
  CircularLight(const DiskLight& light)  // NOLINT(google-explicit-constructor)
      : CircularLight(light.center, light.normal, light.radius) {}
  CircularLight(const Vec3& disk_center, const Vec3& disk_normal, double disk_radius)
      : center(disk_center), weight(1.0), normal(disk_normal), radius(disk_radius) {}
  CircularLight(const DistantLight& light);  // NOLINT(google-explicit-constructor)

  bool is_distant() const { return weight == 0.0; }
  bool operator==(const CircularLight&) const = default;
};

/// An orthonormal frame of directions: w along the light's normal, and u × v = w. The same normal always
/// gives the same frame.
struct LightFrame {
  Vec3 u, v, w;
};
LightFrame light_frame(const CircularLight& light);

/// The way from p to the disk's center. Of a distant light it is the unit vector towards it, so that adding
/// radius · e, with a unit vector e across, gives the way to the rim of either kind.
Vec3 way_to_center(const CircularLight& light, const Vec3& p);

/// The points p of the disk with the largest and the smallest N·p: center ± radius · N⊥/|N⊥|, where N⊥ = N -
/// (N·m)m and m is the light's unit normal. Where N is parallel to m, or 0, every point is extreme, and both
/// are the center. They are pnear and pfar of "Umbra and penumbra volumes" (2004), eq. 1, with sign and
/// length corrected. Of a distant light they are directions, the center being -m. In plain double; classes
/// are decided by predicates.h.
struct ExtremePoints {
  /// The largest N·p. A face that does not look at this point looks at none of the disk.
  Vec3 near;
  /// The smallest N·p. A face that looks at this point looks at all of the disk.
  Vec3 far;
};
ExtremePoints extreme_points(const CircularLight& light, const Vec3& plane_normal);

/// True on the light's plane and behind it, where nothing of the light's front is seen. Never true of a
/// distant light. In plain double, for images; topology asks side_of_light_plane of predicates.h.
bool is_behind(const CircularLight& light, const Vec3& point);

}  // namespace penumbra
