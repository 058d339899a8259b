// A bounded intersection of half-spaces, exactly.
#pragma once

#include <span>
#include <vector>

#include "penumbra/mesh/types.h"

namespace penumbra::detail {

/// Below the plane through three points that run counter-clockwise seen from outside.
using HalfSpace = std::array<Vec3, 3>;

struct HalfSpaceCell {
  std::vector<Vec3> positions;             ///< rounded to the nearest double
  std::vector<IndexedTriangle> triangles;  ///< outward; every half-edge matched by its opposite
  std::vector<std::uint32_t> half_spaces;  ///< per triangle the one that bounds it there
};

/// The average of the four points of `inside` has to be strictly inside of every half-space, and the
/// intersection bounded; empty where the former is not so. Vertices where more than three planes meet exactly
/// are one vertex. Expected cost O(n log n).
HalfSpaceCell intersect_half_spaces(std::span<const HalfSpace> half_spaces,
                                    const std::array<Vec3, 4>& inside);

}  // namespace penumbra::detail
