// Eight merged edges in float, in the light's frame (light radii): which of them lie beside it for certain.
//
// What a merged edge stands for is seen within its margin, by receivers that are twice the radius of its
// curved sides away (MergedSides). So it is no silhouette across the disk where its ends lie beyond a plane
// that holds receivers and disk on its other side, by the margin: for receivers of a shaft one of the shaft's
// sides, and for one receiver x the plane through x that touches the disk towards the edge's middle. In float
// with the margin of block_bounds.h; what is left is asked in double (uncertain_edges.h).
#pragma once

#include <array>
#include <cstdint>

#include "render/silhouette/merge/merged_edges.h"
#include "render/support/float_lanes.h"

namespace penumbra::detail {

class Shaft;
struct TileReceiver;

struct alignas(kFloatLanes * sizeof(float)) MergedLanes {
  std::array<Floats, 3> a, b;
  Floats margin;
  struct Side {
    std::array<Floats, 3> center;
    Floats reach;  ///< twice the radius; less than 0 for what is flat
  };
  Side left, right;

  MergedLanes() = default;
  /// For coordinates up to `extent`. Lanes beyond the block's edges are beside everything.
  MergedLanes(const MergedBlock& block, double extent);
};

/// Receivers of a shaft, or one.
struct FloatShaft {
  FloatShaft(const Shaft& shaft, double extent);
  static constexpr std::size_t kSides = 16;
  std::array<float, kSides> x, y, slope, least;  ///< x p.x + y p.y - slope p.z is `least` or less inside
  std::array<float, kSides> steep;               ///< how much that changes over a distance, at most
  std::array<float, 3> middle;
  float size;  ///< half the diagonal of the receivers' box
};
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
