// Triangles inside a closed line in the plane.
//
// In: points and the line as a sequence of them. The line may touch itself: it may run along a bridge to a
// hole and back, and pass one point more than once. Out: triangles over the same points whose sum has the
// line as its boundary. They cover what the line winds round once. Nothing where it crosses itself, winds
// round something twice, or winds round one part to the left and another to the right.
//
// A constrained triangulation (square_triangulation.h). All signs are exact. Where a point lies on a piece of
// the line between two others, a triangle without area closes the gap, so that a neighbor along the whole
// piece stays a neighbor.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "mesh/polygons/orientation.h"
#include "penumbra/mesh/types.h"

namespace penumbra::detail {

/// The points are distinct and within [-1, 1]². The line closes itself behind its last point. Triangles run
/// as the line does. Expected cost O(n log n) for lines without very long pieces, O(n²) at worst.
std::optional<std::vector<IndexedTriangle>> triangulate_line(std::span<const Vec2> points,
                                                             std::span<const std::uint32_t> line);

}  // namespace penumbra::detail
