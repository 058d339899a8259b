// Occlusion textures, step 4: rectangles of a texture, in texels. Texel (i, j) is the square [i, i+1) × [j,
// j+1).
//
// Every prefilter has `covered(box)`: the integral of the texture (0 to 1) over the box, in texels². The box
// may jut out of the texture or be larger than it. Outside the texture is empty; nothing wraps around.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "render/support/vector_clones.h"

namespace penumbra::detail {

struct TexelBox {
  double x0, y0, x1, y1;
  double width() const { return x1 - x0; }
  double height() const { return y1 - y0; }
  double area() const { return width() * height(); }
  bool empty() const { return !(x0 < x1 && y0 < y1); }
};

/// Boxes that are asked for together, by their sides.
struct TexelBoxes {
  static constexpr std::size_t kMost = 256;
  std::size_t count = 0;
  alignas(64) std::array<double, kMost> x0, y0, x1, y1;
  TexelBox operator[](std::size_t i) const { return {x0[i], y0[i], x1[i], y1[i]}; }
};

/// One box after the other, for filters that cannot be asked for several at a time.
template <class Filter>
void covered_each(const Filter& filter, const TexelBoxes& boxes, double* out) {
  for (std::size_t i = 0; i < boxes.count; ++i) out[i] = filter.covered(boxes[i]);
}

/// The part within a texture of `size` × `size` texels; empty() where there is none.
PENUMBRA_INLINE TexelBox clipped(const TexelBox& b, double size) {
  return {std::clamp(b.x0, 0.0, size), std::clamp(b.y0, 0.0, size), std::clamp(b.x1, 0.0, size),
          std::clamp(b.y1, 0.0, size)};
}

/// A square by its low corner.
struct TexelSquare {
  double x, y, side;
};

/// Speed: squares that a long box is read by, at most. Beyond it they are taken larger than the box is wide,
/// which blurs.
inline constexpr int kMostSquares = 16;

/// What of [from, from + length) lies in [0, size], as an interval of length `size`; length > size.
inline double within_texture(double from, double length, double size) {
  return from < 0.0 ? std::min(from + length - size, 0.0) : from;
}

/// The sum of mean(square) · area over squares of 1 to `size` texels a side, for a square of any size: one
/// that is larger than the texture sees no more of it than the right one of the texture's size does.
template <class Mean>
double covered_by_square(const TexelSquare& s, double size, const Mean& mean) {
  if (s.side <= size) return s.side * s.side * mean(TexelSquare{s.x, s.y, s.side});
  const double x = within_texture(s.x, s.side, size), y = within_texture(s.y, s.side, size);
  return size * size * mean(TexelSquare{x, y, size});
}

/// `covered` by a filter that only knows the mean of squares. A box that is not square is tiled from its low
/// end; what is left of its length is read by the square at its high end and weighted by that rest, so that
/// the answer is continuous in the box.
template <class Mean>
double covered_by_squares(const TexelBox& b, double size, const Mean& mean) {
  const double w = b.width(), h = b.height(), length = std::max(w, h), breadth = std::min(w, h);
  const double side = std::max(breadth, length / kMostSquares), wider = 0.5 * (side - breadth);
  const double rounding = 1e-9 * length;
  const auto square_at = [&](double along) {
    const TexelSquare square = w >= h ? TexelSquare{b.x0 + along, b.y0 - wider, side}
                                      : TexelSquare{b.x0 - wider, b.y0 + along, side};
    return covered_by_square(square, size, mean) * breadth / side;
  };
  double sum = 0.0, done = 0.0;
  for (; done + side <= length + rounding; done += side) sum += square_at(done);
  if (length - done > rounding) sum += square_at(length - side) * (length - done) / side;
  return sum;
}

/// 8-bit coverage as 16-bit fixed point: levels of a pyramid are rounded to this.
inline constexpr double kFixedOne = 65535.0;
inline std::uint16_t to_fixed(std::uint8_t coverage) {
  return static_cast<std::uint16_t>(coverage * 257);
}
inline std::uint16_t mean_of_four(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  return static_cast<std::uint16_t>((a + b + c + d + 2) / 4);
}

}  // namespace penumbra::detail
