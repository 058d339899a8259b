#include "render/n_buffer.h"

#include <bit>
#include <cmath>

namespace penumbra::detail {

NBuffer::NBuffer(std::span<const std::uint8_t> texels, int size) : size_(size) {
  auto& first = levels_.emplace_back(texels.size());
  std::transform(texels.begin(), texels.end(), first.begin(), to_fixed);
  for (std::size_t half = 1; half < static_cast<std::size_t>(size); half *= 2) {
    const std::size_t n = static_cast<std::size_t>(size) + 1 - 2 * half, finer_n = n + half;
    std::vector<std::uint16_t> level(n * n);
    const std::vector<std::uint16_t>& finer = levels_.back();
    for (std::size_t j = 0; j < n; ++j) {
      const std::uint16_t* low = finer.data() + j * finer_n;
      const std::uint16_t* high = low + half * finer_n;
      std::uint16_t* out = level.data() + j * n;
      for (std::size_t i = 0; i < n; ++i)
        out[i] = mean_of_four(low[i], low[i + half], high[i], high[i + half]);
    }
    levels_.push_back(std::move(level));
  }
}

/// The box of side 2^level about (x, y).
double NBuffer::box_mean(std::size_t level, double x, double y) const {
  const int side = 1 << level, n = size_ - side + 1;
  const double u = std::clamp(x - 0.5 * side, 0.0, n - 1.0), v = std::clamp(y - 0.5 * side, 0.0, n - 1.0);
  const int i = static_cast<int>(u), j = static_cast<int>(v);
  const int right = std::min(i + 1, n - 1), above = std::min(j + 1, n - 1);
  const std::uint16_t* low =
      levels_[level].data() + static_cast<std::size_t>(j) * static_cast<std::size_t>(n);
  const std::uint16_t* high =
      levels_[level].data() + static_cast<std::size_t>(above) * static_cast<std::size_t>(n);
  const double fx = u - i, fy = v - j;
  const double a = low[i] + fx * (low[right] - low[i]), b = high[i] + fx * (high[right] - high[i]);
  return a + fy * (b - a);
}

double NBuffer::mean(double x, double y, double side) const {
  const double within = std::clamp(side, 1.0, static_cast<double>(size_));
  const auto level = static_cast<std::size_t>(std::bit_width(static_cast<unsigned>(within)) - 1);
  const double lower = static_cast<double>(1 << level), share = within / lower - 1.0;
  const double fine = box_mean(level, x, y);
  if (share == 0.0) return fine / kFixedOne;
  return (fine + share * (box_mean(level + 1, x, y) - fine)) / kFixedOne;
}

double NBuffer::covered(const TexelBox& box) const {
  return covered_by_squares(box, [this](double x, double y, double side) { return mean(x, y, side); });
}

std::size_t NBuffer::bytes() const {
  std::size_t sum = 0;
  for (const auto& level : levels_) sum += level.size() * sizeof(std::uint16_t);
  return sum;
}

}  // namespace penumbra::detail
