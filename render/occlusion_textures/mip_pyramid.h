// Occlusion textures, step 4, prefilter 1 of 3: the mipmap pyramid, read trilinearly.
//
// "Occlusion textures" (2006), section 3.2. Each level averages 2 × 2 texels of the one before; a kernel of
// side s reads the two levels next to log2 s. The cheapest, and blocky: texels that are neighbors are
// averaged together only far up. Levels are 16-bit, where the paper's are 8-bit.
#pragma once

#include <span>
#include <vector>

#include "render/occlusion_textures/texel_box.h"

namespace penumbra::detail {

class MipPyramid {
 public:
  /// `texels`: size² values, row by row; size is a power of two. O(size²).
  MipPyramid(std::span<const std::uint8_t> texels, int size);
  /// Eight reads for a square. What is left of a box at the border is read by smaller squares: a level that
  /// reached beyond it would see too little.
  double covered(const TexelBox& any_box) const;
  void covered(const TexelBoxes& boxes, double* out) const { covered_each(*this, boxes, out); }
  std::size_t bytes() const;

 private:
  double mean(const TexelSquare& square) const;
  double bilinear(std::size_t level, double x, double y) const;
  std::vector<std::vector<std::uint16_t>> levels_;
};

}  // namespace penumbra::detail
