// Closed forms for the tests of the oracle: parts of a disk's area.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/oracle/oracle.h"

namespace penumbra::oracle {

/// The share of the unit disk with x < d.
inline double share_below(double d) {
  d = std::clamp(d, -1.0, 1.0);
  return 0.5 + (std::asin(d) + d * std::sqrt(1 - d * d)) / std::numbers::pi;
}

/// The share of the unit disk with x ≥ a and y ≥ b, where (a, b) lies inside the disk: the integral over x
/// from a of √(1 - x²) - max(b, -√(1 - x²)).
inline double share_of_quadrant(double a, double b) {
  const auto area = [](double x) { return (x * std::sqrt(1 - x * x) + std::asin(x)) / 2; };
  const double end = std::sqrt(1 - b * b);
  if (b < 0 && a > end) return 2 * (area(1) - area(a)) / std::numbers::pi;
  const double beyond = b < 0 ? 2 * (area(1) - area(end)) : 0.0;
  return (area(end) - area(a) - b * (end - a) + beyond) / std::numbers::pi;
}

/// The share of the unit disk that lies in a disk of radius s around a point d away: a lens of two segments.
inline double share_in_disk(double s, double d) {
  if (d >= 1 + s) return 0;
  if (d <= std::abs(1 - s)) return std::min(1.0, s * s);
  const auto segment = [](double radius, double distance) {
    return radius * radius * std::acos(distance / radius) -
           distance * std::sqrt(radius * radius - distance * distance);
  };
  const double chord = (d * d + 1 - s * s) / (2 * d);
  return (segment(1, chord) + segment(s, d - chord)) / std::numbers::pi;
}

inline TriangleMesh make_quad(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 corners[] = {a, b, c, d};
  const IndexedTriangle faces[] = {{0, 1, 2}, {0, 2, 3}};
  return TriangleMesh::build(corners, faces);
}

/// The rectangle [x0, x1] × [z0, z1] at height y.
inline TriangleMesh make_sheet(double y, double x0, double x1, double z0, double z1) {
  return make_quad({x0, y, z0}, {x0, y, z1}, {x1, y, z1}, {x1, y, z0});
}

/// A plate at height y from a hole of this radius to an outer one, both around the axis x = z = 0.
inline TriangleMesh make_plate_with_hole(double y, double hole, double outer) {
  constexpr std::uint32_t kSides = 1000;
  std::vector<Vec3> points;
  std::vector<IndexedTriangle> faces;
  for (std::uint32_t i = 0; i < kSides; ++i) {
    const double angle = 2 * std::numbers::pi * i / kSides, x = std::cos(angle), z = std::sin(angle);
    points.emplace_back(hole * x, y, hole * z);
    points.emplace_back(outer * x, y, outer * z);
    const std::uint32_t next = 2 * ((i + 1) % kSides);
    faces.push_back({2 * i, 2 * i + 1, next});
    faces.push_back({next, 2 * i + 1, next + 1});
  }
  return TriangleMesh::build(points, faces);
}

/// A light at height `height` above a point of the ground. It shines down.
inline DiskLight light_above(const Vec3& ground, double height, double radius) {
  return {{ground.x, ground.y + height, ground.z}, {0, -1, 0}, radius};
}

}  // namespace penumbra::oracle
