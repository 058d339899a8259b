// Whether a face hides one point from another: what rays in float ask where they cannot tell.
#pragma once

#include "penumbra/mesh/types.h"
#include "render/support/plane_side.h"

namespace penumbra::detail {

/// True where the open segment between x and q meets the face, its border included. A face hides nothing where x or q
/// lies in its plane as far as double can tell (side_of_plane). On which side of an edge the segment passes is decided
/// by exact predicates, so that no segment slips between two faces at a common edge. Coordinates must neither overflow
/// nor vanish when three of them are multiplied. Cost: some 100 ns.
bool hides(const FaceCorners& face, const Vec3& x, const Vec3& q);

}  // namespace penumbra::detail
