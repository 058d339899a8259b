#include "render/light/disk_area.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace penumbra {
namespace {

constexpr double kPi = std::numbers::pi;

/// Length of the chord at distance `d` that lies in the half-plane at distance `other`, whose normal makes
/// the given angle.
double kept_length(double d, double other, double cosine, double sine) {
  const double half = std::sqrt(std::max(0.0, 1.0 - d * d));
  // (d cos - other) / sin without cancellation. The large term is the same for both chords but for its sign,
  // so that what sin has lost where they nearly coincide drops out of δ1 L1 + δ2 L2.
  const double s = std::max(sine, 1e-300);
  const double start = cosine > 0.0 ? (d - other) / s - d * sine / (1.0 + cosine)
                                    : d * sine / (1.0 - cosine) - (d + other) / s;
  return half - std::clamp(start, -half, half);
}

/// Overlap of the intervals [-p, p] and [at - q, at + q].
double overlap(double p, double at, double q) {
  return std::max(0.0, std::min(p, at + q) - std::max(-p, at - q));
}

}  // namespace

Vec3 edge_plane(const Vec3& x, const Vec3& a, const Vec3& b) {
  return glm::cross(a - x, b - a);
}

Chord chord_of_plane(const Vec3& n, const Vec3& x, double r) {
  const double length = std::hypot(n.x, n.y);
  return {length > 0.0 ? glm::dvec2(n.x, n.y) / length : glm::dvec2(1.0, 0.0),
          -glm::dot(n, x) / (r * length)};
}

double half_plane_area(double delta) {
  if (!(delta > -1.0)) return 0.0;
  if (delta >= 1.0) return 1.0;
  return 0.5 + (std::asin(delta) + delta * std::sqrt((1.0 - delta) * (1.0 + delta))) / kPi;
}

double half_plane_area_fast(double delta) {
  const double s = std::min(std::abs(delta), 1.0);
  const double tail = (1.0 - s) * std::sqrt(1.0 - s) * (0.5 + s * (0.11275 - 0.01345 * s));
  return delta > 0.0 ? 1.0 - tail : tail;
}

double two_half_planes_area(const Chord& one, const Chord& two) {
  if (one.delta >= 1.0) return half_plane_area(two.delta);
  if (two.delta >= 1.0) return half_plane_area(one.delta);
  if (!(one.delta > -1.0) || !(two.delta > -1.0)) return 0.0;
  const double cosine = std::clamp(glm::dot(one.normal, two.normal), -1.0, 1.0);
  const double sine = std::abs(one.normal.x * two.normal.y - one.normal.y * two.normal.x);
  const double angle = std::atan2(sine, cosine);
  // The half-plane's arc reaches acos(-δ) to either side of its normal.
  const double reach1 = std::acos(-one.delta), reach2 = std::acos(-two.delta);
  const double arc = overlap(reach1, angle, reach2) + overlap(reach1, angle - 2.0 * kPi, reach2);
  const double twice = one.delta * kept_length(one.delta, two.delta, cosine, sine) +
                       two.delta * kept_length(two.delta, one.delta, cosine, sine) + arc;
  return std::clamp(0.5 * twice / kPi, 0.0, 1.0);
}

}  // namespace penumbra
