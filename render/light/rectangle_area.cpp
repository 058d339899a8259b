#include "render/light/rectangle_area.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>

namespace penumbra::detail {
namespace {

/// A convex polygon in z = 0 that turns left: four corners and one more where the horizon cuts one off.
struct Polygon {
  std::array<glm::dvec2, 5> corners;
  std::size_t count = 0;
};

Polygon above_horizon(const Vec3& x, const Vec3& n, const glm::dvec2& half) {
  const std::array<glm::dvec2, 4> all{glm::dvec2(-half.x, -half.y), glm::dvec2(half.x, -half.y), half,
                                      glm::dvec2(-half.x, half.y)};
  const auto height = [&](const glm::dvec2& p) { return glm::dot(n, Vec3(p, 0.0) - x); };
  Polygon out;
  for (std::size_t i = 0; i < 4; ++i) {
    const glm::dvec2 &a = all[i], &b = all[(i + 1) % 4];
    const double ha = height(a), hb = height(b);
    if (ha > 0.0) out.corners[out.count++] = a;
    if ((ha > 0.0) != (hb > 0.0)) out.corners[out.count++] = a + (b - a) * (ha / (ha - hb));
  }
  return out;
}

}  // namespace

double edge_irradiance(const Vec3& p, const Vec3& q, const Vec3& n) {
  const Vec3 c = glm::cross(p, q);
  const double size = glm::length(c);
  return size > 0.0 ? -0.5 * glm::dot(n, c) / size * std::atan2(size, glm::dot(p, q)) : 0.0;
}

double rectangle_irradiance_factor(const Vec3& x, const Vec3& n, const glm::dvec2& half) {
  if (x.z <= 0.0) return 0.0;
  const Polygon seen = above_horizon(x, n, half);
  double sum = 0.0;
  for (std::size_t i = 0; i < seen.count; ++i)
    sum +=
        edge_irradiance(Vec3(seen.corners[i], 0.0) - x, Vec3(seen.corners[(i + 1) % seen.count], 0.0) - x, n);
  return std::max(0.0, sum);
}

double rectangle_above_horizon(const Vec3& x, const Vec3& n, const glm::dvec2& half) {
  if (x.z <= 0.0) return 0.0;
  const Polygon seen = above_horizon(x, n, half);
  double twice = 0.0;
  for (std::size_t i = 0; i < seen.count; ++i)
    twice += glm::determinant(glm::dmat2(seen.corners[i], seen.corners[(i + 1) % seen.count]));
  return std::clamp(twice / (8.0 * half.x * half.y), 0.0, 1.0);
}

}  // namespace penumbra::detail
