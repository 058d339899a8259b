// Rectangles of a texture, in texels: texel (i, j) is the square [i, i+1) × [j, j+1).
//
// Every prefilter answers `covered(box)`: the integral of the texture (0 to 1) over a box that lies within
// it, in texels². What a kernel sees beyond the texture is empty, so that a kernel which juts out is clipped
// and nothing wraps around.
#pragma once

#include <algorithm>
#include <cstdint>

namespace penumbra::detail {

struct TexelBox {
  double x0, y0, x1, y1;
  double width() const { return x1 - x0; }
  double height() const { return y1 - y0; }
  double area() const { return width() * height(); }
  bool empty() const { return !(x0 < x1 && y0 < y1); }
};

/// The part within a texture of `size` × `size` texels; empty() where there is none.
inline TexelBox clipped(const TexelBox& b, double size) {
  return {std::clamp(b.x0, 0.0, size), std::clamp(b.y0, 0.0, size), std::clamp(b.x1, 0.0, size),
          std::clamp(b.y1, 0.0, size)};
}

/// Squares that a long box is read by, at most; beyond it they are taken larger than the box is wide.
inline constexpr int kMostSquares = 16;

/// `covered` by a filter that only knows squares: mean_of_square(center x, center y, side). A box that is not
/// square is tiled from its low end; what is left of its length is read by the square at its high end and
/// weighted by that rest, so that the answer is continuous in the box.
template <class MeanOfSquare>
double covered_by_squares(const TexelBox& b, const MeanOfSquare& mean_of_square) {
  const double length = std::max(b.width(), b.height());
  const double side = std::max(std::min(b.width(), b.height()), length / kMostSquares);
  const bool lies = b.width() >= b.height();
  const double across = lies ? 0.5 * (b.y0 + b.y1) : 0.5 * (b.x0 + b.x1), from = lies ? b.x0 : b.y0;
  const auto mean_at = [&](double along) {
    return lies ? mean_of_square(along, across, side) : mean_of_square(across, along, side);
  };
  const double rounding = 1e-9 * length;
  double sum = 0.0, done = 0.0;
  for (; done + side <= length + rounding; done += side) sum += side * mean_at(from + done + 0.5 * side);
  if (length - done > rounding) sum += (length - done) * mean_at(from + length - 0.5 * side);
  return sum * (lies ? b.height() : b.width());
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
