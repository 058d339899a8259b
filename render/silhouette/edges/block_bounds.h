// Bounds of eight neighboring blocks of edges in float, and on which sides of their faces points lie.
//
// All is in float with a margin of 2^-17 M, M the largest coordinate: a sum here has a dozen terms of at most
// 7 M, each off by 2^-24 of that.
#pragma once

#include <array>
#include <cmath>

#include "penumbra/mesh/types.h"
#include "render/support/float_lanes.h"

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

/// normal·p + offset, more than 0 outside, and how much it varies over half a box.
struct FloatPlane {
  FloatPlane() = default;
  FloatPlane(const Vec3& n, double offset_less_margin) : offset(static_cast<float>(offset_less_margin)) {
    for (int k = 0; k < 3; ++k) {
      normal[k] = static_cast<float>(n[k]);
      steep[k] = std::abs(normal[k]);
    }
  }
  PENUMBRA_INLINE Ints has_outside(const Children& c) const {
    const Floats at = normal[0] * c.middle[0] + normal[1] * c.middle[1] + normal[2] * c.middle[2];
    return at + offset > steep[0] * c.half[0] + steep[1] * c.half[1] + steep[2] * c.half[2];
  }
  std::array<float, 3> normal, steep;
  float offset;
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

/// Blocks wholly below the tangent planes of receivers: normal·(p - middle of the receivers) < lowest for all
/// normals of a box.
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

/// The same by the planes of the blocks' faces, which is closer where a block lies along the surface and the
/// normals differ little: a corner p of a face with normal n and a value v at the box's middle m has n·(p -
/// m) = -v.
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

/// Drops blocks for receivers in a box, by the sides of planes alone.
class SidesTest {
 public:
  explicit SidesTest(const FloatBox& receivers) : receivers_(receivers) {}
  SidesTest(const Vec3& middle, const Vec3& half) : receivers_(middle, half) {}
  PENUMBRA_INLINE std::uint32_t dropped(const Children& c) const {
    return bits_of(are_one_sided(c, receivers_));
  }

 private:
  FloatBox receivers_;
};

}  // namespace penumbra::detail
