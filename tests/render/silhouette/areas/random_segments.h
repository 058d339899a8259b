// Segments in the plane of the disk: outlines of random polygons, and horizons.
#pragma once

#include <cmath>
#include <glm/vec2.hpp>
#include <vector>

#include "render/silhouette/edges/projected_segment.h"
#include "tests/render/render_support.h"

namespace penumbra::testing {

/// A horizon that cuts the disk.
inline Chord random_horizon(Random& random) {
  return {random.unit2(), random.uniform(-0.95, 0.95)};
}

/// Closed outlines of random polygons, as faces would leave them: jump 2 inside.
inline std::vector<detail::Segment> random_polygons(Random& random, int count) {
  std::vector<detail::Segment> segments;
  for (int p = 0; p < count; ++p) {
    const glm::dvec2 middle{random.uniform(-1, 1), random.uniform(-1, 1)};
    const double size = random.spread(0.05, 2.0), start = random.uniform(0, 6.3);
    const int corners = 3 + p % 4;
    const auto corner = [&](int k) {
      const double angle = start + 2.0 * kPi * (k % corners) / corners;
      return middle + size * glm::dvec2(std::cos(angle), std::sin(angle));
    };
    for (int k = 0; k < corners; ++k) segments.push_back({corner(k), corner(k + 1), 2});
  }
  return segments;
}

/// Number of polygons over p (each edge with the inside on its left), by winding.
inline int winding(const std::vector<detail::Segment>& segments, const glm::dvec2& p) {
  int sum = 0;
  for (const detail::Segment& s : segments) {
    if ((s.a.y <= p.y) == (s.b.y <= p.y)) continue;
    const double x = s.a.x + (s.b.x - s.a.x) * (p.y - s.a.y) / (s.b.y - s.a.y);
    if (x > p.x) sum += s.b.y > s.a.y ? 1 : -1;
  }
  return sum;
}

}  // namespace penumbra::testing
