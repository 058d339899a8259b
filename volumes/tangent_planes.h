// The planes through an edge that touch the disk: what the 2004 paper extrudes (its points pu and pp), with
// no special case for edges parallel to the light.
//
// n = αu1 + βu2 in a basis of the plane perpendicular to the edge that does not depend on the center;
// tangency is q(n) = (n·w)² - r²|m × n|² = 0 with w = center - v1 and m the unit normal: a quadratic form
// whose two roots are the two planes; q negative definite iff the line crosses the open disk.
#pragma once

#include <array>
#include <optional>

#include "penumbra/volumes/disk_light.h"

namespace penumbra {

struct TangentPlane {
  Vec3 normal;   ///< unit; the disk lies in the closed half-space normal·(p - v1) ≥ 0
  Vec3 contact;  ///< the disk's point on the plane: where light grazes it from
};

/// Both tangent planes, or nothing where the edge's line crosses the open disk (by the exact predicate) or,
/// at radius 0, passes through the center. planes[0] is Tangent::kFirst of predicates.h: orient3d(v1, v2,
/// contact, center) ≥ 0 and normal = (v2 - v1) × (contact - v1) up to length; planes[1] is kSecond, with the
/// opposite signs. At radius 0, and for an edge in the light's plane, the two coincide but face opposite ways
/// (see predicates.h); the contact is then the center. A line that touches the rim has one plane, returned
/// twice, with its contact on the line. Accuracy of the normals about 1e-12 away from tangency of the line
/// itself; see the tests. v1 ≠ v2. Cost O(1).
std::optional<std::array<TangentPlane, 2>> tangent_planes(const Vec3& v1, const Vec3& v2,
                                                          const DiskLight& light);

}  // namespace penumbra
