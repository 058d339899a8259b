// Silhouette method, step edges: bounds of eight neighboring blocks of edges in float, and tests of all
// eight at once.
//
// In: the bounds of eight blocks (`Children`), and a plane, a box of receivers or a box of their normals.
// Out: one lane a block, true where the block can be dropped.
//
// All is in float with a margin of kBoundsGrain = 2^-17 times M, M the largest coordinate: a sum here has a
// dozen terms of at most 7 M, each off by 2^-24 of that.
#pragma once

#include <array>
#include <cmath>

#include "penumbra/mesh/types.h"
#include "render/support/float_lanes.h"

namespace penumbra::detail {

/// Accuracy. The margin of sums in float, over the largest coordinate. Held by the tests SceneEdges,
/// EdgeBlocks and MergedEdgeTests.
inline constexpr double kBoundsGrain = 0x1p-17;

/// Bounds of eight blocks, a lane each. Ranges are given by their middle and half of their width.
struct alignas(kFloatLanes * sizeof(float)) Children {
  /// Of the box of a block's edges, and of the box of the normals of their faces.
  std::array<Floats, 3> middle, half, normal, normal_half;
  /// Half the diagonal of the box of the edges in x and y.
  Floats across;
  /// Of the values of the faces' planes at the middle of the box.
  Floats value, value_half;
};

/// A box in float.
struct FloatBox {
  FloatBox() = default;
  FloatBox(const Vec3& m, const Vec3& h) {
    for (int k = 0; k < 3; ++k) {
      middle[k] = static_cast<float>(m[k]);
      half[k] = static_cast<float>(h[k]);
    }
  }
  std::array<float, 3> middle{}, half{};
};

/// A plane in float: normal·p + offset is more than 0 outside.
struct FloatPlane {
  FloatPlane() = default;
  /// The margin is taken off the offset by the caller.
  FloatPlane(const Vec3& n, double offset_less_margin) : offset(static_cast<float>(offset_less_margin)) {
    for (int k = 0; k < 3; ++k) {
      normal[k] = static_cast<float>(n[k]);
      steep[k] = std::abs(normal[k]);
    }
  }
  /// True for blocks that lie wholly outside.
  PENUMBRA_INLINE Ints has_outside(const Children& c) const {
    const Floats at = normal[0] * c.middle[0] + normal[1] * c.middle[1] + normal[2] * c.middle[2];
    return at + offset > steep[0] * c.half[0] + steep[1] * c.half[1] + steep[2] * c.half[2];
  }
  /// `steep`: the magnitudes of the normal's components, so how much the value varies over a box.
  std::array<float, 3> normal, steep;
  float offset;
};

/// True for blocks of which all planes have one sign for all receivers in a box. The box is one of
/// homogeneous points (p, weight): weight 1 for points, 0 for directions.
PENUMBRA_INLINE Ints are_one_sided(const Children& c, const FloatBox& receivers, float weight = 1.0f) {
  Floats value = weight * c.value, reach = weight * c.value_half;
  for (int k = 0; k < 3; ++k) {
    const Floats d = receivers.middle[k] - weight * c.middle[k];
    value += c.normal[k] * d;
    reach +=
        c.normal_half[k] * (magnitude(d) + receivers.half[k]) + magnitude(c.normal[k]) * receivers.half[k];
  }
  return magnitude(value) > reach;
}

/// True for blocks that lie wholly below the tangent planes of receivers: normal·(p - m) < lowest for all
/// normals of a box, m the middle of the receivers.
PENUMBRA_INLINE Ints are_below(const Children& c, const FloatBox& receivers, const FloatBox& normals,
                               float lowest) {
  Floats highest{};
  for (int k = 0; k < 3; ++k) {
    const Floats d = c.middle[k] - receivers.middle[k];
    highest += normals.middle[k] * d + normals.half[k] * magnitude(d) +
               (std::abs(normals.middle[k]) + normals.half[k]) * c.half[k];
  }
  return highest < lowest;
}

/// The same by the planes of the blocks' faces: a corner p of a face with normal n and value v at the
/// middle m of the box has n·(p - m) = -v. This is closer where a block lies along the surface and the
/// normals differ little.
PENUMBRA_INLINE Ints are_under(const Children& c, const FloatBox& receivers, const FloatBox& normals,
                               float lowest) {
  Floats highest = c.value_half - c.value;
  for (int k = 0; k < 3; ++k) {
    const Floats d = c.middle[k] - receivers.middle[k];
    const Floats apart = magnitude(normals.middle[k] - c.normal[k]) + c.normal_half[k] + normals.half[k];
    highest += normals.middle[k] * d + normals.half[k] * magnitude(d) + apart * c.half[k];
  }
  return highest < lowest;
}

/// A test of blocks for `BoundsTree`: drops those whose planes have one sign for all receivers in a box, or
/// for all points of a light (`weight` as in are_one_sided).
class SidesTest {
 public:
  explicit SidesTest(const FloatBox& receivers, float weight = 1.0f)
      : receivers_(receivers), weight_(weight) {}
  SidesTest(const Vec3& middle, const Vec3& half) : receivers_(middle, half) {}
  /// Bit i is set where block i is dropped.
  PENUMBRA_INLINE std::uint32_t dropped(const Children& c) const {
    return bits_of(are_one_sided(c, receivers_, weight_));
  }

 private:
  FloatBox receivers_;
  float weight_ = 1.0f;
};

}  // namespace penumbra::detail
