// Convex hull of points in space, combinatorially exact: quickhull (Barber, Dobkin, Huhdanpaa, "The quickhull
// algorithm for convex hulls", 1996) with every sign from orient3d, so that coplanar and nearly coplanar
// points need no tolerance.
#pragma once

#include <span>
#include <vector>

#include "mesh/types.h"

namespace penumbra::detail {

/// Triangles over the indices of `points`, oriented outward; closed; together a triangulated sphere. Every
/// point is inside or on the hull exactly. Points on a facet or an edge of the hull of the others may or may
/// not be vertices; of equal points at most one is. Empty where fewer than four points are affinely
/// independent. Deterministic. Expected cost O(n log n).
std::vector<IndexedTriangle> convex_hull(std::span<const Vec3> points);

}  // namespace penumbra::detail
