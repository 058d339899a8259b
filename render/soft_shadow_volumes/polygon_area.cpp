#include "render/soft_shadow_volumes/polygon_area.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace penumbra::detail {
namespace {

double height(const Chord& half_plane, const glm::dvec2& p) {
  return glm::dot(half_plane.normal, p) + half_plane.delta;
}

/// Of the unit disk between the rays from its center through two points.
double sector(const glm::dvec2& p, const glm::dvec2& q) {
  return 0.5 * std::atan2(cross(p, q), glm::dot(p, q));
}

/// The part of a segment in the unit disk; without length where there is none.
struct Inside {
  glm::dvec2 from, to;
};
Inside inside_of(const glm::dvec2& p, const glm::dvec2& q) {
  const glm::dvec2 way = q - p;
  const double a = glm::dot(way, way), b = glm::dot(p, way), area = cross(p, q);
  // b² - a (|p|² - 1), without cancellation.
  const double root2 = a - area * area;
  if (!(root2 > 0.0)) return {p, p};
  const double root = std::sqrt(root2);
  const double first = (-b - root) / a, last = (-b + root) / a;
  if (first >= 1.0 || last <= 0.0) return {p, p};
  // Ends inside stay what they are: near the center a rounding would turn them.
  return {first > 0.0 ? p + first * way : p, last < 1.0 ? p + last * way : q};
}

}  // namespace

void clip(const Polygon& polygon, const Chord& half_plane, Polygon& out) {
  out.clear();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec2 &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const double at_p = height(half_plane, p), at_q = height(half_plane, q);
    if (at_p >= 0.0) out.push_back(p);
    if ((at_p >= 0.0) != (at_q >= 0.0)) out.push_back(p + (at_p / (at_p - at_q)) * (q - p));
  }
}

double area_of(const Polygon& polygon) {
  double sum = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i)
    sum += cross(polygon[i], polygon[(i + 1) % polygon.size()]);
  return 0.5 * sum;
}

double area_in_disk(const Polygon& polygon) {
  double sum = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec2 &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const auto [from, to] = inside_of(p, q);
    if (from == to)
      sum += sector(p, q);
    else
      sum += sector(p, from) + 0.5 * cross(from, to) + sector(to, q);
  }
  return sum;
}

glm::dvec2 centroid_of(const Polygon& polygon) {
  glm::dvec2 sum(0.0);
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec2 &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    sum += cross(p, q) * (p + q);
  }
  return sum / (6.0 * area_of(polygon));
}

double distance_to(const glm::dvec2& p, const glm::dvec2& a, const glm::dvec2& b) {
  const glm::dvec2 way = b - a, to = p - a;
  const double length2 = glm::dot(way, way);
  const double t = length2 > 0.0 ? std::clamp(glm::dot(to, way) / length2, 0.0, 1.0) : 0.0;
  return glm::length(to - t * way);
}

Chord left_of(const glm::dvec2& a, const glm::dvec2& b) {
  const glm::dvec2 way = b - a;
  const double length = glm::length(way);
  const glm::dvec2 normal(-way.y / length, way.x / length);
  return {normal, cross(a, b) / length};
}

double area_behind(const glm::dvec2& a, const glm::dvec2& b) {
  const auto [from, to] = inside_of(a, b);
  return from == to ? 0.0 : sector(from, to) - 0.5 * cross(from, to);
}

}  // namespace penumbra::detail
