// Silhouette method, step collect: which merged edges may stand for a silhouette across the disk, in float.
//
// In: eight merged edges, and the receivers of a shaft or one receiver. Out: a bit an edge, clear where
// what it stands for is certain to lie beside the disk.
//
// What a merged edge stands for is seen within its margin, by receivers that are at twice the radius of its
// curved sides or more (MergedSides). So it is no silhouette across the disk where both its ends lie beyond
// some plane by the margin, and the receivers and the disk lie on that plane's other side. For the
// receivers of a shaft these are the sides of the shaft. For one receiver x it is the plane through x that
// touches the disk towards the middle of the edge.
//
// All is in float with the margin of block_bounds.h. What is left is tested in double (uncertain_edges.h).
#pragma once

#include <array>
#include <cstdint>

#include "render/silhouette/collect/shaft.h"
#include "render/silhouette/merge/merged_lanes.h"

namespace penumbra::detail {

/// The sides of a shaft. `extent`: the largest coordinate.
struct FloatShaft {
  FloatShaft(const Shaft& shaft, double extent);
  static constexpr std::size_t kSides = 16;
  /// x p.x + y p.y - slope p.z is `least` or less inside.
  std::array<float, kSides> x, y, slope, least;
  /// By how much that changes over a distance of 1, at most.
  std::array<float, kSides> steep;
  /// The middle of the receivers' box, and half its diagonal.
  std::array<float, 3> middle;
  float size;
};

/// One receiver.
struct FloatEye {
  FloatEye(const TileReceiver& receiver, double extent);
  std::array<float, 3> at;
  float per_z, grain;
};

/// Bit i is set where edge i may stand for a silhouette across the disk. Compiled for several instruction
/// sets with the same result.
std::uint32_t may_be_across(const MergedLanes& edges, const FloatShaft& receivers);
std::uint32_t may_be_across(const MergedLanes& edges, const FloatEye& receiver);

}  // namespace penumbra::detail
