#include "render/variance/moment_table.h"

#include <algorithm>
#include <cmath>

namespace penumbra::detail {

DepthScale::DepthScale(double nearness_of_map, double top, double bottom) : nearness(nearness_of_map) {
  first = -top / (1.0 + nearness * top);
  const double last = -bottom / (1.0 + nearness * bottom);
  range = last > first ? last - first : 1.0;
}

double DepthScale::depth_of(double height) const {
  return std::clamp((-height / (1.0 + nearness * height) - first) / range, 0.0, 1.0);
}

double DepthScale::height_of(double depth) const {
  const double w = first + range * depth;
  return -w / (1.0 + nearness * w);
}

MomentTable::MomentTable(const ShadowMap& map, const DepthScale& scale, double warp)
    : map_(map),
      warp_(warp),
      size_(map.size()),
      sums_(static_cast<std::size_t>(size_ + 1) * static_cast<std::size_t>(size_ + 1), Sums{}) {
  const std::size_t row = static_cast<std::size_t>(size_) + 1;
  for (int y = 0; y < size_; ++y) {
    Sums line{};
    for (int x = 0; x < size_; ++x) {
      const float height = map.at(x, y);
      const double z = height == ShadowMap::kNothing ? 1.0 : scale.depth_of(height);
      const Sums texel = sums_of(z);
      for (std::size_t k = 0; k < line.size(); ++k) line[k] += texel[k];
      const std::size_t corner = (static_cast<std::size_t>(y) + 1) * row + static_cast<std::size_t>(x) + 1;
      for (std::size_t k = 0; k < line.size(); ++k) sums_[corner][k] = sums_[corner - row][k] + line[k];
    }
  }
}

Warped MomentTable::warped(double depth) const {
  if (!(warp_ > 0.0)) return {depth, depth};
  return {std::exp(warp_ * (depth - 1.0)), -std::exp(-warp_ * depth)};
}

Warped MomentTable::rise(double depth) const {
  if (!(warp_ > 0.0)) return {1.0, 1.0};
  const Warped w = warped(depth);
  return {warp_ * w.far, -warp_ * w.near};
}

MomentTable::Sums MomentTable::sums_of(double depth) const {
  const Warped w = warped(depth);
  return {depth, w.far, w.far * w.far, w.near, w.near * w.near};
}

/// Texels are constant, so that sums are bilinear within each.
MomentTable::Sums MomentTable::sums_until(double x, double y) const {
  const int column = std::min(static_cast<int>(x), size_ - 1),
            line = std::min(static_cast<int>(y), size_ - 1);
  const double s = x - column, t = y - line;
  const std::size_t row = static_cast<std::size_t>(size_) + 1;
  const Sums* below = &sums_[static_cast<std::size_t>(line) * row + static_cast<std::size_t>(column)];
  const Sums* above = below + row;
  Sums out;
  for (std::size_t k = 0; k < out.size(); ++k)
    out[k] = (1.0 - t) * ((1.0 - s) * below[0][k] + s * below[1][k]) +
             t * ((1.0 - s) * above[0][k] + s * above[1][k]);
  return out;
}

Moments MomentTable::mean(const glm::dvec2& place, const glm::dvec2& half_size) const {
  const glm::dvec2 at = map_.texels_to(place);
  const double half_x = std::max(0.5, half_size.x * map_.per_texel().x),
               half_y = std::max(0.5, half_size.y * map_.per_texel().y);
  const auto inside = [&](double x) { return std::clamp(x, 0.0, static_cast<double>(size_)); };
  const double x0 = inside(at.x - half_x), x1 = inside(at.x + half_x), y0 = inside(at.y - half_y),
               y1 = inside(at.y + half_y);
  const double area = 4.0 * half_x * half_y, beside = area - (x1 - x0) * (y1 - y0);
  const Sums a = sums_until(x0, y0), b = sums_until(x1, y0), c = sums_until(x0, y1), d = sums_until(x1, y1);
  Sums mean;
  const Sums bottom = sums_of(1.0);
  for (std::size_t k = 0; k < mean.size(); ++k)
    mean[k] = (d[k] - c[k] - b[k] + a[k] + beside * bottom[k]) / area;
  return {mean[0], mean[1], mean[2], mean[3], mean[4]};
}

}  // namespace penumbra::detail
