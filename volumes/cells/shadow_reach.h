// How far sheets and volumes reach, and the light's frame that they are made in.
#pragma once

#include <glm/geometric.hpp>

#include "penumbra/mesh/triangle_mesh.h"
#include "penumbra/volumes/disk_light.h"
#include "penumbra/volumes/extrude.h"

namespace penumbra::detail {

/// The light's frame and the sphere that the far end of every piece must lie beyond.
struct ShadowReach {
  Vec3 center;       ///< of the light
  LightFrame frame;  ///< w points to the front
  double radius;     ///< of the light
  Vec3 bound_center;
  double bound_radius;
  /// A plane parallel to the light at this depth is beyond the bound. Negative where the bound is behind the
  /// light.
  double far_depth;

  /// The distance in front of the light's plane, negative behind it.
  double depth(const Vec3& p) const { return glm::dot(frame.w, p - center); }
  /// An upper bound of the distance between a point of the bound and a point of the disk.
  double distance() const;
};

/// Throws UsageError unless the bound is a finite sphere and the polygon around the disk has 3 corners or
/// more.
void require_valid(const ExtrudeOptions& options);

/// Throws UsageError as require_valid does.
ShadowReach shadow_reach(const TriangleMesh& mesh, const DiskLight& light, const ExtrudeOptions& options);

}  // namespace penumbra::detail
