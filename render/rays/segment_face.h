// Whether a face hides one point from another: what rays in float ask where they cannot tell.
#pragma once

#include "penumbra/mesh/types.h"
#include "render/support/plane_side.h"

namespace penumbra::detail {

// A face hides q from x where its plane separates them and the line through them meets it, its border included. It hides
// nothing where x or q lies in its plane as far as double can tell (side_of_plane). Coordinates must neither overflow nor
// vanish when three of them are multiplied.

/// x and q lie on different sides of the plane. Cost: some 30 ns.
bool separates(const FaceCorners& face, const Vec3& x, const Vec3& q);

/// The line meets the face and does not lie in its plane. On which side of an edge it passes is decided by exact
/// predicates, so that no line slips between two faces at a common edge. Cost: some 50 ns.
bool line_meets(const FaceCorners& face, const Vec3& x, const Vec3& q);

}  // namespace penumbra::detail
