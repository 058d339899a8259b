#include "render/occlusion_textures/mip_pyramid.h"

#include <cmath>

namespace penumbra::detail {

MipPyramid::MipPyramid(std::span<const std::uint8_t> texels, int size) {
  auto& first = levels_.emplace_back(texels.size());
  std::transform(texels.begin(), texels.end(), first.begin(), to_fixed);
  for (std::size_t n = static_cast<std::size_t>(size) / 2; n > 0; n /= 2) {
    std::vector<std::uint16_t> level(n * n);
    const std::vector<std::uint16_t>& finer = levels_.back();
    for (std::size_t j = 0; j < n; ++j)
      for (std::size_t i = 0; i < n; ++i) {
        const std::uint16_t* p = finer.data() + 4 * j * n + 2 * i;
        level[j * n + i] = mean_of_four(p[0], p[1], p[2 * n], p[2 * n + 1]);
      }
    levels_.push_back(std::move(level));
  }
}

/// Position in texels of the finest level; beyond the border the border's texels go on.
double MipPyramid::bilinear(std::size_t level, double x, double y) const {
  const int n = 1 << (levels_.size() - 1 - level);
  const double scale = 1.0 / static_cast<double>(1 << level);
  const double u = std::clamp(x * scale - 0.5, 0.0, n - 1.0), v = std::clamp(y * scale - 0.5, 0.0, n - 1.0);
  const int i = static_cast<int>(u), j = static_cast<int>(v);
  const int right = std::min(i + 1, n - 1), above = std::min(j + 1, n - 1);
  const auto at = [&](int column, int row) {
    return static_cast<double>(levels_[level][static_cast<std::size_t>(row * n + column)]);
  };
  const double fx = u - i, fy = v - j;
  const double low = at(i, j) + fx * (at(right, j) - at(i, j));
  const double high = at(i, above) + fx * (at(right, above) - at(i, above));
  return low + fy * (high - low);
}

double MipPyramid::mean(const TexelSquare& s) const {
  const double top = static_cast<double>(levels_.size() - 1);
  const double x = s.x + 0.5 * s.side, y = s.y + 0.5 * s.side;
  const double lambda = std::clamp(std::log2(s.side), 0.0, top);
  const auto level = static_cast<std::size_t>(lambda);
  const double share = lambda - static_cast<double>(level);
  const double fine = bilinear(level, x, y);
  if (share == 0.0) return fine / kFixedOne;
  return (fine + share * (bilinear(level + 1, x, y) - fine)) / kFixedOne;
}

double MipPyramid::covered(const TexelBox& any_box) const {
  const double size = static_cast<double>(1 << (levels_.size() - 1));
  const TexelBox box = clipped(any_box, size);
  if (box.empty()) return 0.0;
  return covered_by_squares(box, size, [this](const TexelSquare& s) { return mean(s); });
}

std::size_t MipPyramid::bytes() const {
  std::size_t sum = 0;
  for (const auto& level : levels_) sum += level.size() * sizeof(std::uint16_t);
  return sum;
}

}  // namespace penumbra::detail
