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
  /// Sixteen reads.
  double covered(const TexelBox& any_box) const;
  std::size_t bytes() const { return sums_.size() * sizeof(sums_[0]); }

 private:
  std::vector<std::uint32_t> sums_;  ///< (size + 1)²; [j][i]: all texels below and left of corner (i, j)
  int size_;
};

}  // namespace penumbra::detail
