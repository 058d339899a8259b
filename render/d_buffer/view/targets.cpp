#include "render/d_buffer/view/targets.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace penumbra::detail {
namespace {

/// Rows of the matrix are the axes.
glm::dmat3 rows(const Vec3& right, const Vec3& up, const Vec3& forward) {
  return glm::transpose(glm::dmat3(right, up, forward));
}

/// The square of how much longer than along the axis a line of sight is.
double stretch(const glm::dvec2& uv) {
  return 1.0 + glm::dot(uv, uv);
}

}  // namespace

bool needs_hemicube(const UvBounds& window) {
  const glm::dvec2 farthest = glm::max(glm::abs(window.low), glm::abs(window.high));
  if (std::max(farthest.x, farthest.y) <= kWidestWindow) return false;
  const glm::dvec2 nearest = glm::clamp(glm::dvec2(0.0), window.low, window.high);
  return !(stretch(farthest) <= stretch(glm::dvec2(kWidestWindow, 0.0)) * stretch(nearest));
}

Target one_target(const UvBounds& window, int size) {
  const double margin = 2.0 * std::max(window.extent(), 0x1p-30) / (size - 4);
  return {glm::dmat3(1.0),
          {window.low.x - margin, window.high.x + margin, window.low.y - margin, window.high.y + margin}};
}

std::vector<Target> hemicube(const UvBounds& window) {
  const Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  // A side faces ±x or ±y with "up" along z; its lower half would look behind the light, where nothing casts.
  const std::array<double, 4> full{-1, 1, -1, 1}, front{-1, 1, 0, 1};
  std::vector<Target> sides{{rows(x, y, z), full}};
  const auto &low = window.low, &high = window.high;
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
