#include "volumes/solids/simplify/one_sided_point.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace penumbra::detail {
namespace {

/// Of the trace: how strongly a point is drawn to the start, where planes leave it free.
constexpr double kDrawn = 1e-4;
constexpr int kSweeps = 60;
constexpr std::size_t kMostLimits = 64;

glm::dmat3 inverse_of(const Quadric& q, const PlacementOptions& options) {
  const auto& m = q.matrix;
  const double trace = m[0] + m[3] + m[5], drawn = kDrawn * trace + 1e-300;
  glm::dmat3 a(m[0] + drawn, m[1], m[2], m[1], m[3] + drawn, m[4], m[2], m[4], m[5] + drawn);
  for (int k = 0; k < 3; ++k)
    if (options.fixed[k])
      for (int i = 0; i < 3; ++i) a[k][i] = a[i][k] = i == k ? trace + drawn : 0.0;
  glm::dmat3 inverse = glm::inverse(a);
  for (int k = 0; k < 3; ++k)
    if (options.fixed[k])
      for (int i = 0; i < 3; ++i) inverse[k][i] = inverse[i][k] = 0.0;
  return inverse;
}

}  // namespace

void Quadric::add_plane(const Vec3& n, const Vec3& p, double w) {
  const double d = glm::dot(n, p);
  matrix[0] += w * n.x * n.x;
  matrix[1] += w * n.x * n.y;
  matrix[2] += w * n.x * n.z;
  matrix[3] += w * n.y * n.y;
  matrix[4] += w * n.y * n.z;
  matrix[5] += w * n.z * n.z;
  linear += w * d * n;
  constant += w * d * d;
}

Quadric& Quadric::operator+=(const Quadric& other) {
  for (std::size_t i = 0; i < matrix.size(); ++i) matrix[i] += other.matrix[i];
  linear += other.linear;
  constant += other.constant;
  return *this;
}

double Quadric::at(const Vec3& x) const {
  const auto& m = matrix;
  const Vec3 ax(m[0] * x.x + m[1] * x.y + m[2] * x.z, m[1] * x.x + m[3] * x.y + m[4] * x.z,
                m[2] * x.x + m[4] * x.y + m[5] * x.z);
  return glm::dot(x, ax) - 2.0 * glm::dot(linear, x) + constant;
}

/// C. Hildreth's dual ascent (1957): half-space by half-space, each multiplier to where its own is met or 0.
std::optional<Vec3> place_one_sided(const Quadric& q, std::span<const PlaneLimit> limits, const Vec3& start,
                                    const PlacementOptions& options) {
  if (limits.size() > kMostLimits) return std::nullopt;
  const auto& m = q.matrix;
  const glm::dmat3 inverse = inverse_of(q, options);
  const Vec3 gradient =
      Vec3(m[0] * start.x + m[1] * start.y + m[2] * start.z, m[1] * start.x + m[3] * start.y + m[4] * start.z,
           m[2] * start.x + m[4] * start.y + m[5] * start.z) -
      q.linear;
  Vec3 x = start - inverse * gradient;
  const auto worst = [&] {
    double most = -1e300;
    for (const PlaneLimit& h : limits) most = std::max(most, glm::dot(h.normal, x) - h.offset);
    return most;
  };
  if (worst() <= options.rounding) return x;
  std::array<double, kMostLimits> multiplier{}, curvature{};
  std::array<Vec3, kMostLimits> way;
  for (std::size_t i = 0; i < limits.size(); ++i) {
    way[i] = inverse * limits[i].normal;
    curvature[i] = glm::dot(limits[i].normal, way[i]);
  }
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (std::size_t i = 0; i < limits.size(); ++i) {
      if (!(curvature[i] > 0.0)) continue;
      const PlaneLimit& h = limits[i];
      const double beyond = glm::dot(h.normal, x) - h.offset + options.margin;
      const double change = std::max(beyond / curvature[i], -multiplier[i]);
      multiplier[i] += change;
      x -= change * way[i];
    }
    if (worst() <= options.rounding) return x;
  }
  return std::nullopt;
}

}  // namespace penumbra::detail
