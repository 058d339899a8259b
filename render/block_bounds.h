// Bounds of eight neighbouring blocks of edges in float, and on which sides of their faces points lie.
//
// All is in float with a margin of 2^-17 M, M the largest coordinate: a sum here has a dozen terms of at most
// 7 M, each off by 2^-24 of that.
#pragma once

#include <array>
#include <cmath>

#include "mesh/types.h"
#include "render/float_lanes.h"

namespace penumbra::detail {

inline constexpr double kBoundsGrain = 0x1p-17;

/// Boxes of eight blocks, and of the planes of their faces the normals and the values at the box's middle;
/// each a middle and half of a range.
struct alignas(kFloatLanes * sizeof(float)) Children {
  std::array<Floats, 3> middle, half, normal, normal_half;
  Floats across;  ///< the box's half diagonal in x and y
  Floats value, value_half;
};

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

/// All planes of a block have one sign for receivers in a box.
PENUMBRA_INLINE Ints are_one_sided(const Children& c, const FloatBox& receivers) {
  Floats value = c.value, reach = c.value_half;
  for (int k = 0; k < 3; ++k) {
    const Floats d = receivers.middle[k] - c.middle[k];
    value += c.normal[k] * d;
    reach +=
        c.normal_half[k] * (magnitude(d) + receivers.half[k]) + magnitude(c.normal[k]) * receivers.half[k];
  }
  return magnitude(value) > reach;
}

/// Drops blocks for receivers in a box, by the sides of planes alone.
class SidesTest {
 public:
  SidesTest(const Vec3& middle, const Vec3& half) : receivers_(middle, half) {}
  PENUMBRA_INLINE std::uint32_t dropped(const Children& c) const {
    return bits_of(are_one_sided(c, receivers_));
  }

 private:
  FloatBox receivers_;
};

}  // namespace penumbra::detail
