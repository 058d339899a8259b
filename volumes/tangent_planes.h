// The planes through an edge that touch the disk: what the 2004 paper extrudes (its points pu and pp). Edges
// that are parallel to the light are no special case.
//
// A normal is n = αu1 + βu2, in a basis of the plane perpendicular to the edge that does not depend on the
// center. With w = center - v1 (of a distant light w = -m) and m the light's unit normal, the plane is
// tangent where q(n) = (n·w)² - r²|m × n|² is 0. This quadratic form of α and β has two roots, the two
// planes. It is negative definite where the edge's line crosses the open disk.
#pragma once

#include <array>
#include <optional>

#include "penumbra/volumes/disk_light.h"

namespace penumbra {

struct TangentPlane {
  /// Unit. The disk lies in the closed half-space normal·(p - v1) ≥ 0.
  Vec3 normal;
  /// The point of the disk on the plane, from where light grazes it. Of a distant light the direction to that
  /// point, -m + radius · e with unit vectors m and e.
  Vec3 contact;
  /// The way from v1 to the contact, which large coordinates do not round. Of a distant light it is the
  /// contact.
  Vec3 way;
};

/// Both tangent planes through the line v1 → v2, which are different points. planes[0] is Tangent::kFirst of
/// predicates.h: orient3d(v1, v2, contact, center) ≥ 0, and its normal is (v2 - v1) × (contact - v1) up to
/// length. planes[1] is kSecond, with the opposite signs.
///
/// Nothing where the line crosses the open disk (by the exact predicate) or, at radius 0, passes through the
/// center. At radius 0, and for an edge in the light's plane, the two planes coincide but face opposite ways
/// (see predicates.h); the contact is then the center. A line that touches the rim has one plane, which is
/// returned twice, with its contact on the line.
///
/// Normals are accurate to about 1e-12, but where the line nearly touches the rim; see the tests. Cost O(1).
std::optional<std::array<TangentPlane, 2>> tangent_planes(const Vec3& v1, const Vec3& v2,
                                                          const CircularLight& light);

}  // namespace penumbra
