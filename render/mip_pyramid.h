// Prefilter 1 of 3: the mipmap pyramid, read trilinearly.
//
// "Occlusion textures" (2006), section 3.2. Each level averages 2 × 2 texels of the one before; a kernel of
// side s reads the two levels next to log2 s. The cheapest, and blocky: texels that are neighbours are
// averaged together only far up. Levels are 16-bit, where the paper's are 8-bit.
#pragma once

#include <span>
#include <vector>

#include "render/texel_box.h"

namespace penumbra::detail {

class MipPyramid {
 public:
  /// `texels`: size² values, row by row; size is a power of two. O(size²).
  MipPyramid(std::span<const std::uint8_t> texels, int size);
  /// Eight reads for a square. Precondition: the box lies within the texture.
  double covered(const TexelBox& box) const;
  std::size_t bytes() const;

 private:
  double mean(double x, double y, double side) const;
  double bilinear(std::size_t level, double x, double y) const;
  std::vector<std::vector<std::uint16_t>> levels_;
};

}  // namespace penumbra::detail
