// Prefilter 3 of 3: a summed-area table, exact for every box.
//
// "Occlusion textures" (2006), section 3.2. Sums are 32-bit integers of 8-bit coverage: exact up to 4096²
// texels, where float sums lose texels from 256² on. A box's borders need not lie on texels: the table
// interpolated linearly is the exact integral of the texture taken as constant on each texel. In plain C++,
// since a scan is serial along its rows and a software rasteriser gains nothing on it.
#pragma once

#include <span>
#include <vector>

#include "render/texel_box.h"

namespace penumbra::detail {

class SummedArea {
 public:
  /// `texels`: size² values, row by row. O(size²).
  SummedArea(std::span<const std::uint8_t> texels, int size);
  /// Sixteen reads, also of a box that misses the texture: what is seen does not change the cost.
  double covered(const TexelBox& any_box) const {
    const TexelBox box = clipped(any_box, size_);
    const Between x0 = between(box.x0), x1 = between(box.x1), y0 = between(box.y0), y1 = between(box.y1);
    const double low = strip(y0.low, x0, x1), high = strip(y1.low, x0, x1);
    const double sum = high - low + y1.share * (strip(y1.low + 1, x0, x1) - high) -
                       y0.share * (strip(y0.low + 1, x0, x1) - low);
    return sum / 255.0;
  }
  std::size_t bytes() const { return sums_.size() * sizeof(sums_[0]); }

 private:
  /// A border between the two corners next to it.
  struct Between {
    std::size_t low;
    double share;  ///< of the corner above `low`
  };
  Between between(double at) const {
    const int low = std::min(static_cast<int>(at), size_ - 1);
    return {static_cast<std::size_t>(low), at - low};
  }
  /// Sums below a row's border between two borders in x: differences of integers first, which are exact.
  double strip(std::size_t row, const Between& x0, const Between& x1) const {
    const std::uint32_t* s = sums_.data() + row * (static_cast<std::size_t>(size_) + 1);
    const std::uint32_t a = s[x0.low], b = s[x1.low];
    return static_cast<double>(b - a) + x1.share * (s[x1.low + 1] - b) - x0.share * (s[x0.low + 1] - a);
  }

  std::vector<std::uint32_t> sums_;  ///< (size + 1)²; [j][i]: all texels below and left of corner (i, j)
  int size_;
};

}  // namespace penumbra::detail
