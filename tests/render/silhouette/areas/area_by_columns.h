// How much of the disk nothing hides, by columns: the yardstick of areas. It shares nothing with render/: it
// looks along columns, not rows, finds crossings among all pairs, clips nothing, and integrates by Gauss'
// rule.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "render/silhouette/edges/projected_segment.h"

namespace penumbra::testing {

/// Closed outlines over the part n·p + δ ≥ 0 of the unit disk.
class AreaByColumns {
 public:
  using Real = long double;

  AreaByColumns(const std::vector<detail::Segment>& segments, const glm::dvec2& normal, double delta)
      : normal_(normal), delta_(delta) {
    for (const detail::Segment& s : segments)
      if (s.a.x != s.b.x) columns_of(s);
  }

  /// The share of the whole disk over which the number of faces is 0.
  double visible() const {
    const std::vector<Real> angles = make_angles();
    // Gauss' points and weights of order 5 on [-1, 1].
    static constexpr std::array<std::pair<Real, Real>, 5> kGauss{
        {{0.0L, 0.568888888888888888889L},
         {0.538469310105683091036L, 0.478628670499366468041L},
         {-0.538469310105683091036L, 0.478628670499366468041L},
         {0.906179845938663992798L, 0.236926885056189087514L},
         {-0.906179845938663992798L, 0.236926885056189087514L}}};
    Real sum = 0.0L;
    std::vector<std::pair<Real, int>> crossings;
    for (std::size_t i = 1; i < angles.size(); ++i) {
      const Real middle = (angles[i] + angles[i - 1]) / 2, half = (angles[i] - angles[i - 1]) / 2;
      for (const auto& [at, weight] : kGauss) {
        const Real angle = middle + half * at;
        sum += weight * half * std::cos(angle) * free_length(std::sin(angle), crossings);
      }
    }
    return static_cast<double>(sum / kPiLong);
  }

 private:
  /// A segment that is not upright, from left to right; `change` is that of the number of faces upwards
  /// across it.
  struct Line {
    Real left, right, y, slope;
    int change;
    Real at(Real x) const { return y + slope * (x - left); }
  };
  static constexpr Real kPiLong = 3.14159265358979323846264338327950288L;

  void columns_of(const detail::Segment& s) {
    const bool ahead = s.b.x > s.a.x;
    const glm::dvec2 &a = ahead ? s.a : s.b, &b = ahead ? s.b : s.a;
    lines_.push_back(
        {a.x, b.x, a.y, (Real(b.y) - Real(a.y)) / (Real(b.x) - Real(a.x)), ahead ? s.jump : -s.jump});
  }

  /// x = sin(angle) of ends, crossings and of where lines and the chord meet the rim; none more than .1
  /// apart.
  std::vector<Real> make_angles() const {
    std::vector<Real> places{-1.0L, 1.0L};
    const auto meet_rim = [&](Real y0, Real slope) {  // y = y0 + slope x
      const Real a = 1 + slope * slope, b = y0 * slope, c = y0 * y0 - 1, root = b * b - a * c;
      if (root < 0) return;
      places.push_back((-b + std::sqrt(root)) / a);
      places.push_back((-b - std::sqrt(root)) / a);
    };
    if (normal_.y != 0.0) meet_rim(-Real(delta_) / normal_.y, -Real(normal_.x) / normal_.y);
    if (normal_.x != 0.0) places.push_back(-Real(delta_) / normal_.x);
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      const Line& p = lines_[i];
      places.push_back(p.left);
      places.push_back(p.right);
      meet_rim(p.at(0), p.slope);
      if (normal_.y != 0.0)
        meet(p, {-2, 2, (2 * Real(normal_.x) - delta_) / normal_.y, -Real(normal_.x) / normal_.y, 0}, places);
      for (std::size_t j = 0; j < i; ++j) meet(p, lines_[j], places);
    }
    std::vector<Real> angles;
    for (const Real x : places)
      if (x >= -1 && x <= 1) angles.push_back(std::asin(x));
    for (int k = -15; k <= 15; ++k) angles.push_back(k * kPiLong / 32);
    std::sort(angles.begin(), angles.end());
    return angles;
  }

  static void meet(const Line& p, const Line& q, std::vector<Real>& places) {
    if (p.right <= q.left || q.right <= p.left || p.slope == q.slope) return;
    const Real x = (q.at(0) - p.at(0)) / (p.slope - q.slope);
    if (x > std::max(p.left, q.left) && x < std::min(p.right, q.right)) places.push_back(x);
  }

  /// The length of what nothing hides of the column at x.
  Real free_length(Real x, std::vector<std::pair<Real, int>>& crossings) const {
    Real low = -std::sqrt(1 - x * x), high = -low;
    if (normal_.y != 0.0) {
      const Real chord = -(Real(normal_.x) * x + delta_) / normal_.y;
      (normal_.y > 0.0 ? low : high) = normal_.y > 0.0 ? std::max(low, chord) : std::min(high, chord);
    } else if (normal_.x * x + delta_ < 0) {
      return 0;
    }
    crossings.clear();
    for (const Line& line : lines_)
      if (line.left <= x && x < line.right) crossings.emplace_back(line.at(x), line.change);
    std::sort(crossings.begin(), crossings.end());
    Real length = 0, from = -4;
    int faces = 0;
    crossings.emplace_back(4, 0);
    for (const auto& [y, change] : crossings) {
      if (faces == 0) length += std::max(Real(0), std::min(y, high) - std::max(from, low));
      faces += change;
      from = y;
    }
    return length;
  }

  glm::dvec2 normal_;
  double delta_;
  std::vector<Line> lines_;
};

/// The number of faces over p.
inline int faces_over(const std::vector<detail::Segment>& segments, const glm::dvec2& p) {
  int faces = 0;
  for (const detail::Segment& s : segments) {
    if ((s.a.x <= p.x) == (s.b.x <= p.x)) continue;
    const double y = s.a.y + (s.b.y - s.a.y) * (p.x - s.a.x) / (s.b.x - s.a.x);
    if (y < p.y) faces += s.b.x > s.a.x ? s.jump : -s.jump;
  }
  return faces;
}

}  // namespace penumbra::testing
