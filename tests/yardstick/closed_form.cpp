#include "tests/yardstick/closed_form.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace penumbra::yardstick {
namespace {

double cross(const Point& p, const Point& q) {
  return p.x * q.y - p.y * q.x;
}
double dot(const Point& p, const Point& q) {
  return p.x * q.x + p.y * q.y;
}
Point between(const Point& p, const Point& q, double t) {
  return {p.x + t * (q.x - p.x), p.y + t * (q.y - p.y)};
}
double sector(const Point& p, const Point& q) {
  return 0.5 * std::atan2(cross(p, q), dot(p, q));
}

// The line p + t(q - p) is in the disk for t of [low, high]: |d|²t² + 2(p·d)t + |p|² - 1 ≤ 0. The
// discriminant is |d|² - (p × d)², and the distance of the line from the center is |p × d|/|d|.
double edge_area(const Point& p, const Point& q) {
  const Point d{q.x - p.x, q.y - p.y};
  const double length2 = dot(d, d), moment = cross(p, d);
  if (length2 == 0.0) return 0.0;
  const double middle = -dot(p, d) / length2, inside2 = length2 - moment * moment;
  if (inside2 <= 0.0) return sector(p, q);
  const double half = std::sqrt(inside2) / length2, low = middle - half, high = middle + half;
  if (low >= 1.0 || high <= 0.0) return sector(p, q);
  const Point enter = low > 0.0 ? between(p, q, low) : p, leave = high < 1.0 ? between(p, q, high) : q;
  double area = 0.5 * cross(enter, leave);
  if (low > 0.0) area += sector(p, enter);
  if (high < 1.0) area += sector(leave, q);
  return area;
}

struct Axes {
  Vec3 u, v, m;
};
Axes axes_of(const Vec3& normal) {
  const Vec3 m = normal / std::sqrt(glm::dot(normal, normal));
  const Vec3 u = glm::normalize(std::abs(m.x) < 0.7 ? Vec3(0, m.z, -m.y) : Vec3(-m.z, 0, m.x));
  return {u, glm::cross(m, u), m};
}

}  // namespace

double area_in_unit_disk(std::span<const Point> polygon) {
  double area = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i)
    area += edge_area(polygon[i], polygon[(i + 1) % polygon.size()]);
  return area;
}

std::vector<Point> seen_on_light(const DiskLight& light, const Vec3& x, std::span<const Vec3> points) {
  const Axes axes = axes_of(light.normal);
  const Vec3 from_center = x - light.center;
  const double height = glm::dot(from_center, axes.m);
  std::vector<Point> out;
  for (const Vec3& p : points) {
    const Vec3 d = p - x;
    const double t = height / -glm::dot(d, axes.m);
    const Vec3 at = from_center + t * d;
    out.push_back({glm::dot(at, axes.u) / light.radius, glm::dot(at, axes.v) / light.radius});
  }
  return out;
}

std::vector<Point> seen_on_light(const DistantLight& light, const Vec3& x, std::span<const Vec3> points) {
  const Axes axes = axes_of(light.direction);
  const double radius = std::tan(light.angle_degrees / 360.0 * std::numbers::pi);
  std::vector<Point> out;
  for (const Vec3& p : points) {
    const Vec3 d = p - x;
    const double reach = -glm::dot(d, axes.m) * radius;
    out.push_back({glm::dot(d, axes.u) / reach, glm::dot(d, axes.v) / reach});
  }
  return out;
}

}  // namespace penumbra::yardstick
