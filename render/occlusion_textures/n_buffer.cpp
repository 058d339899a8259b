#include "render/occlusion_textures/n_buffer.h"

#include <bit>
#include <cmath>

namespace penumbra::detail {
namespace {

using Level = std::vector<std::uint16_t>;

/// From n² boxes of side `half` to (n + half)² boxes of side 2·half, each the mean of four; those that are
/// not there touch nothing.
Level twice_as_wide(const Level& finer, std::size_t n, std::size_t half) {
  const std::size_t wide = n + half;
  const std::vector<std::uint16_t> nothing(n, 0);
  std::vector<std::uint16_t> low(n + 2 * half, 0), high = low;
  Level out(wide * wide);
  for (std::size_t j = 0; j < wide; ++j) {
    const auto padded = [&](std::size_t row, bool there, Level& into) {
      const std::uint16_t* from = there ? finer.data() + row * n : nothing.data();
      std::copy(from, from + n, into.data() + half);
    };
    padded(j - half, j >= half, low);
    padded(j, j < n, high);
    for (std::size_t i = 0; i < wide; ++i)
      out[j * wide + i] = mean_of_four(low[i], low[i + half], high[i], high[i + half]);
  }
  return out;
}

}  // namespace

NBuffer::NBuffer(std::span<const std::uint8_t> texels, int size) : size_(size) {
  auto& first = levels_.emplace_back(texels.size());
  std::transform(texels.begin(), texels.end(), first.begin(), to_fixed);
  for (std::size_t half = 1; half < static_cast<std::size_t>(size); half *= 2)
    levels_.push_back(twice_as_wide(levels_.back(), static_cast<std::size_t>(size) - 1 + half, half));
}

/// The box of side 2^level whose low corner is (x, y).
double NBuffer::box_mean(std::size_t level, double x, double y) const {
  const int side = 1 << level, n = size_ + side - 1;
  const double u = std::clamp(x + (side - 1), -1.0, static_cast<double>(n)),
               v = std::clamp(y + (side - 1), -1.0, static_cast<double>(n));
  const int i = static_cast<int>(std::floor(u)), j = static_cast<int>(std::floor(v));
  const auto at = [&](int column, int row) {
    const bool touches = column >= 0 && row >= 0 && column < n && row < n;
    return touches ? static_cast<double>(levels_[level][static_cast<std::size_t>(row * n + column)]) : 0.0;
  };
  const double fx = u - i, fy = v - j;
  const double low = at(i, j) + fx * (at(i + 1, j) - at(i, j));
  const double high = at(i, j + 1) + fx * (at(i + 1, j + 1) - at(i, j + 1));
  return low + fy * (high - low);
}

double NBuffer::mean(const TexelSquare& s) const {
  const double side = std::clamp(s.side, 1.0, static_cast<double>(size_));
  const auto level = static_cast<std::size_t>(std::bit_width(static_cast<unsigned>(side)) - 1);
  const double lower = static_cast<double>(1 << level), share = side / lower - 1.0;
  const auto about_center = [&](std::size_t l) {
    const double move = 0.5 * (s.side - static_cast<double>(1 << l));
    return box_mean(l, s.x + move, s.y + move);
  };
  const double fine = about_center(level);
  if (share == 0.0) return fine / kFixedOne;
  return (fine + share * (about_center(level + 1) - fine)) / kFixedOne;
}

double NBuffer::covered(const TexelBox& box) const {
  return covered_by_squares(box, size_, [this](const TexelSquare& s) { return mean(s); });
}

std::size_t NBuffer::bytes() const {
  std::size_t sum = 0;
  for (const auto& level : levels_) sum += level.size() * sizeof(std::uint16_t);
  return sum;
}

}  // namespace penumbra::detail
