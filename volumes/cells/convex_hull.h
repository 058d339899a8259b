// Convex hull of points in space, combinatorially exact.
#pragma once

#include <span>
#include <vector>

#include "penumbra/mesh/types.h"

namespace penumbra::detail {

/// Triangles over the indices of `points`, oriented outward, together a triangulated sphere. Every point is
/// exactly inside or on the hull. A point on a facet or an edge of the hull of the others may or may not be a
/// vertex; of equal points at most one is. Empty where all points lie in one plane. Deterministic. Expected
/// cost O(n log n).
std::vector<IndexedTriangle> convex_hull(std::span<const Vec3> points);

}  // namespace penumbra::detail
