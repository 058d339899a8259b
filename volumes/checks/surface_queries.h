// What is asked of CGAL's polygon mesh processing about sets of triangles. Two triangles share a vertex where
// their corners have the same index, so callers weld first.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "penumbra/mesh/types.h"

namespace penumbra::detail {

using FacePair = std::array<std::uint32_t, 2>;

/// Pairs of triangles that have more in common than shared corners and sides, ascending; at most `limit` of
/// them (which ones is then arbitrary, but the same every time). Exact. No triangle may be without area.
/// Expected cost O(n log n + pairs of overlapping boxes).
std::vector<FacePair> self_intersections(std::span<const Vec3> positions,
                                         std::span<const IndexedTriangle> triangles, std::size_t limit);

/// Whether a closed, oriented surface without self-intersections bounds a volume: its components are nested
/// properly, each is turned outward or inward as its depth asks, and the outermost are turned outward.
/// (CGAL's test alone also accepts all of it turned inside out.) Must only be called on such a surface:
/// elsewhere CGAL's test answers at random and may crash. False where the triangles do not make a manifold.
/// Cost O(n log n).
bool does_bound_a_volume(std::span<const Vec3> positions, std::span<const IndexedTriangle> triangles);

/// The triangles turned to one orientation, by CGAL's orient_polygon_soup. Nothing where they are not a
/// manifold or not orientable, so that vertices would have to be doubled. Cost O(n log n).
std::optional<std::vector<IndexedTriangle>> oriented_alike(std::span<const Vec3> positions,
                                                           std::span<const IndexedTriangle> triangles);

}  // namespace penumbra::detail
