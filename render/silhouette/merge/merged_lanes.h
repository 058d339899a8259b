// Silhouette method, step merge: a block of merged edges in float, in the light's frame (light radii).
//
// In: a block in double. Out: eight lanes, for tests of all its edges at once (collect/merged_edge_tests.h).
#pragma once

#include <array>

#include "render/silhouette/merge/merged_block.h"
#include "render/support/float_lanes.h"

namespace penumbra::detail {

/// A length in float, no less than it is: rounding takes away less than is added. `grain`: what rounding of
/// coordinates adds.
inline float enlarged(double x, double grain) {
  return static_cast<float>((1.0 + 0x1p-20) * x + grain);
}

/// Margins and radii are rounded up, and so is what may be mistaken; ends, centers and normals are rounded.
struct alignas(kFloatLanes * sizeof(float)) MergedLanes {
  /// Ends.
  std::array<Floats, 3> a, b;
  Floats margin;
  struct Side {
    /// On the plane: of a patch its center.
    std::array<Floats, 3> center;
    /// Twice the radius, rounded up; less than 0 for a flat side.
    Floats reach;
    /// Of the plane; 0 where there is no face.
    std::array<Floats, 3> normal;
    Floats tilt, spread;
    /// MergedFaults::Side; `turned` by its rows above the diagonal, and the root of its trace.
    Floats area, shifted, trace;
    std::array<Floats, 6> turned;
  };
  Side left, right;
  /// MergedFaults.
  Floats swept, swept_at_any, stray;
  /// MergedSides::middle and half.
  std::array<Floats, 3> middle, half;
  /// Nothing is mistaken.
  bool is_exact;

  MergedLanes() = default;
  /// For coordinates up to `extent`. A lane without an edge is beside everything: tests dismiss it.
  MergedLanes(const MergedBlock& block, double extent);
};

}  // namespace penumbra::detail
