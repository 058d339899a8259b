#include "render/d_buffer/entries/targets.h"

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>

namespace penumbra::detail {
namespace {

/// Rows of the matrix are the axes.
glm::dmat3 rows(const Vec3& right, const Vec3& up, const Vec3& forward) {
  return glm::transpose(glm::dmat3(right, up, forward));
}

}  // namespace

std::vector<Target> choose_targets(const glm::dvec2& low, const glm::dvec2& high, int size) {
  if (!(low.x <= high.x) || !(low.y <= high.y)) return {};
  const Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  const double margin = 2.0 * std::max({high.x - low.x, high.y - low.y, 1e-9}) / (size - 4);
  const double widest = std::max({std::abs(low.x), std::abs(low.y), std::abs(high.x), std::abs(high.y)});
  if (widest <= kWidestWindow)
    return {{rows(x, y, z), {low.x - margin, high.x + margin, low.y - margin, high.y + margin}}};
  // A side faces ±x or ±y with "up" along z; its lower half would look behind the light, where nothing casts.
  const std::array<double, 4> full{-1, 1, -1, 1}, front{-1, 1, 0, 1};
  std::vector<Target> sides{{rows(x, y, z), full}};
  // The side towards +x sees u ≥ 1, |v| ≤ u; the others alike.
  const auto add = [&](double farthest, double across_low, double across_high, const Target& side) {
    const double nearest_across = std::max({0.0, across_low, -across_high});
    if (farthest >= 1.0 && nearest_across <= farthest) sides.push_back(side);
  };
  add(high.x, low.y, high.y, {rows(y, z, x), front});
  add(-low.x, low.y, high.y, {rows(-y, z, -x), front});
  add(high.y, low.x, high.x, {rows(-x, z, y), front});
  add(-low.y, low.x, high.x, {rows(x, z, -y), front});
  return sides;
}

}  // namespace penumbra::detail
