// Occlusion textures, step 4, prefilter 3 of 3: a summed-area table, exact for every box.
//
// "Occlusion textures" (2006), section 3.2. Sums are 32-bit integers of 8-bit coverage: exact up to 2048²
// texels, where float sums lose texels from 256² on. A box's borders need not lie on texels: the table
// interpolated linearly is the exact integral of the texture taken as constant on each texel. In plain C++,
// since a scan is serial along its rows and a software rasterizer gains nothing on it.
#pragma once

#include <span>
#include <vector>

#include "render/occlusion_textures/texel_box.h"

namespace penumbra::detail {

class SummedArea {
 public:
  /// `texels`: size² values, row by row. O(size²).
  SummedArea(std::span<const std::uint8_t> texels, int size);
  /// Sixteen reads, also of a box that misses the texture: what is seen does not change the cost.
  double covered(const TexelBox& box) const { return Table{sums_.data(), size_}.covered(box); }
  /// The same for many, several at a time; `out`: one a box.
  void covered(const TexelBoxes& boxes, double* out) const;
  std::size_t bytes() const { return sums_.size() * sizeof(sums_[0]); }

 private:
  /// A border between the two corners next to it.
  struct Between {
    std::int32_t low;
    double share;  ///< of the corner above `low`
  };
  /// Indices and differences fit 31 bits, which vectorizes.
  struct Table {
    const std::uint32_t* sums;
    std::int32_t size;

    PENUMBRA_INLINE double covered(const TexelBox& any_box) const {
      const TexelBox box = clipped(any_box, size);
      const Between x0 = between(box.x0), x1 = between(box.x1), y0 = between(box.y0), y1 = between(box.y1);
      const double low = strip(y0.low, x0, x1), high = strip(y1.low, x0, x1);
      const double sum = high - low + y1.share * (strip(y1.low + 1, x0, x1) - high) -
                         y0.share * (strip(y0.low + 1, x0, x1) - low);
      return sum / 255.0;
    }
    PENUMBRA_INLINE Between between(double at) const {
      const std::int32_t low = std::min(static_cast<std::int32_t>(at), size - 1);
      return {low, at - low};
    }
    /// Sums below a row's border between two borders in x: differences of integers first, which are exact.
    PENUMBRA_INLINE double strip(std::int32_t row, const Between& x0, const Between& x1) const {
      const std::int32_t from = row * (size + 1) + x0.low, to = row * (size + 1) + x1.low;
      const std::uint32_t a = sums[from], b = sums[to];
      return difference(b, a) + x1.share * difference(sums[to + 1], b) -
             x0.share * difference(sums[from + 1], a);
    }
    static PENUMBRA_INLINE double difference(std::uint32_t a, std::uint32_t b) {
      return static_cast<std::int32_t>(a - b);
    }
  };

  std::vector<std::uint32_t> sums_;  ///< (size + 1)²; [j][i]: all texels below and left of corner (i, j)
  int size_;
};

}  // namespace penumbra::detail
