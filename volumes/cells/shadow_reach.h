// How far sheets and volumes reach, and the rays that bound them.
//
// Places along the light's axis are heights above the plane through the bound's center, so a light far away
// does not round them. A ray that leaves a point k of the caster is k + h·ray(k, q): h is the height that it
// gains.
#pragma once

#include <glm/geometric.hpp>

#include "penumbra/mesh/triangle_mesh.h"
#include "penumbra/volumes/disk_light.h"
#include "penumbra/volumes/extrude.h"

namespace penumbra::detail {

/// The light's frame and the sphere that the far end of every piece must lie beyond.
struct ShadowReach {
  CircularLight light;
  LightFrame frame;  ///< w points to the front
  Vec3 bound_center;
  double bound_radius;
  /// A plane parallel to the light at this height is beyond the bound.
  double far_height;

  /// Above the plane through the bound's center that is parallel to the light, in the direction in which it
  /// shines.
  double height(const Vec3& p) const { return glm::dot(frame.w, p - bound_center); }
  /// The distance in front of the light's plane, negative behind it; 1 for a distant light.
  double depth(const Vec3& p) const { return light.is_distant() ? 1.0 : glm::dot(frame.w, p - light.center); }
  /// From the disk's center to p; of a distant light the direction in which it shines.
  Vec3 from_center(const Vec3& p) const { return light.is_distant() ? frame.w : p - light.center; }
  /// From the point center + q of the light's plane through k, which is in front, per unit of height. Of a
  /// distant light q is in units of its radius at distance 1.
  Vec3 ray(const Vec3& k, const Vec3& q) const { return (from_center(k) - q) / depth(k); }
  /// An upper bound of the distance between a point of the bound and a point of the disk, which is not
  /// distant.
  double distance() const;
};

/// Throws UsageError unless the bound is a finite sphere and the polygon around the disk has 3 corners or
/// more.
void require_valid(const ExtrudeOptions& options);

/// Throws UsageError as require_valid does.
ShadowReach shadow_reach(const TriangleMesh& mesh, const CircularLight& light, const ExtrudeOptions& options);

}  // namespace penumbra::detail
