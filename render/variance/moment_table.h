// Method variance, step table: means of depths over any window of the map, each by four look-ups.
//
// In: a shadow map, the depths of its top and bottom. Out: summed-area tables of the depth z, from 0 at the
// top to 1 at the bottom, of its warps exp(c (z - 1)) and -exp(-c z), and of their squares. Where the map has
// no caster z is 1.
//
// F. Crow, "Summed-area tables for texture mapping" (1984). Sums are in double: their rounding is 1e-16 of
// the whole map.
#pragma once

#include <array>
#include <vector>

#include "render/center_view/shadow_map.h"

namespace penumbra::detail {

/// How heights of the map become depths: true ones, from the highest caster to the lowest caster or receiver.
struct DepthScale {
  double nearness = 0.0, first = 0.0, range = 1.0;
  /// Of a LightProjection with this nearness.
  DepthScale(double nearness_of_map, double top, double bottom);
  double depth_of(double height) const;
  double height_of(double depth) const;
};

/// A depth warped both ways: the first tells far depths apart, the second near ones.
struct Warped {
  double far, near;
};

/// Means over a window.
struct Moments {
  double depth, far, far2, near, near2;
};

class MomentTable {
 public:
  /// `warp`: c; 0 leaves depths as they are. Cost O(texels).
  MomentTable(const ShadowMap& map, const DepthScale& scale, double warp);

  /// Without a warp both are the depth.
  Warped warped(double depth) const;
  /// Their derivatives.
  Warped rise(double depth) const;
  /// Of the window around a place; at least a texel wide. Beside the map the depth is 1.
  Moments mean(const glm::dvec2& place, const glm::dvec2& half_size) const;

 private:
  using Sums = std::array<double, 5>;
  Sums sums_of(double depth) const;
  Sums sums_until(double x, double y) const;

  const ShadowMap& map_;
  double warp_;
  int size_;
  /// Of all texels below and left of a corner; size + 1 a row.
  std::vector<Sums> sums_;
};

}  // namespace penumbra::detail
