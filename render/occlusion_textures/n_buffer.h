// Occlusion textures, step 4, prefilter 2 of 3: N-buffers, boxes of every power of two at every texel.
//
// "Occlusion textures" (2006), section 3.2, after X. Décoret, "N-buffers for efficient depth map query"
// (2005). Level l holds for each texel t the mean of [t, t + 2^l)². Placed continuously, by linear
// interpolation between texels, such a box is exact; a side between two powers of two interpolates linearly
// between the boxes of both about the same center, which is the filter's error. Levels are 16-bit, where the
// paper's are 8-bit.
#pragma once

#include <span>
#include <vector>

#include "render/occlusion_textures/texel_box.h"

namespace penumbra::detail {

class NBuffer {
 public:
  /// `texels`: size² values, row by row; size is a power of two. O(size² log size).
  NBuffer(std::span<const std::uint8_t> texels, int size);
  /// Eight reads for a square, four where its side is a power of two.
  double covered(const TexelBox& box) const;
  void covered(const TexelBoxes& boxes, double* out) const { covered_each(*this, boxes, out); }
  std::size_t bytes() const;

 private:
  double mean(const TexelSquare& square) const;
  double box_mean(std::size_t level, double x, double y) const;
  /// Level l is (size + 2^l - 1)² values: every box that touches the texture, the first at 1 - 2^l.
  std::vector<std::vector<std::uint16_t>> levels_;
  int size_;
};

}  // namespace penumbra::detail
