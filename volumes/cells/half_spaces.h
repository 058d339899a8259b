// A bounded intersection of half-spaces, computed exactly.
#pragma once

#include <span>
#include <vector>

#include "penumbra/mesh/triangle_mesh.h"
#include "penumbra/mesh/types.h"

namespace penumbra::detail {

/// What is below the plane through three points. Seen from above, which is outside, they run
/// counter-clockwise.
using HalfSpace = std::array<Vec3, 3>;

/// The six of a box.
std::array<HalfSpace, 6> half_spaces_of(const Bounds& box);

struct HalfSpaceCell {
  /// Rounded to the nearest double.
  std::vector<Vec3> positions;
  /// Oriented outward; every half-edge is matched by its opposite.
  std::vector<IndexedTriangle> triangles;
  /// For each triangle the half-space that bounds the cell there.
  std::vector<std::uint32_t> half_spaces;
};

/// The average of the four points of `inside` has to be strictly inside every half-space; where it is not,
/// the result is empty. The intersection has to be bounded. Where more than three planes meet exactly there
/// is one vertex. Expected cost O(n log n) for n half-spaces, in exact arithmetic.
HalfSpaceCell intersect_half_spaces(std::span<const HalfSpace> half_spaces,
                                    const std::array<Vec3, 4>& inside);

}  // namespace penumbra::detail
