#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <map>

#include "mesh/polygons/polygon_triangles.h"
#include "tests/mesh/polygons/random_polygons.h"

namespace penumbra {
namespace {

using detail::divide_polygon;
using detail::PolygonTriangles;
using detail::Vec2;

using Point = std::array<double, 3>;

Point key(const Vec3& p) {
  return {p.x + 0.0, p.y + 0.0, p.z + 0.0};
}

/// How often each pair of points is run along, forth less back.
class Sides {
 public:
  void add(const Vec3& a, const Vec3& b) {
    if (a == b) return;
    const bool up = key(a) < key(b);
    const auto at = net_.try_emplace(up ? std::pair(key(a), key(b)) : std::pair(key(b), key(a)), 0).first;
    if ((at->second += up ? 1 : -1) == 0) net_.erase(at);
  }
  bool operator==(const Sides&) const = default;

 private:
  std::map<std::pair<Point, Point>, int> net_;
};

/// The triangles have the polygon as their boundary, none is turned round, and their areas add up. `unit` is
/// the area vector of a polygon of double area 1; arithmetic is exact.
void expect_divided(const std::vector<Vec3>& corners, const PolygonTriangles& divided, const Vec3& unit,
                    double double_area) {
  Sides outline, sides;
  for (std::size_t i = 0; i < corners.size(); ++i) outline.add(corners[i], corners[(i + 1) % corners.size()]);
  double area = 0.0;
  for (const auto& [a, b, c] : divided.triangles) {
    const Vec3 &p = corners[a], &q = corners[b], &r = corners[c];
    sides.add(p, q), sides.add(q, r), sides.add(r, p);
    const double part = glm::dot(glm::cross(q - p, r - p), unit) / glm::dot(unit, unit);
    EXPECT_GE(part, 0.0);
    area += part;
  }
  EXPECT_EQ(area, double_area);
  EXPECT_TRUE(sides == outline);
}

struct Kind {
  bool slits, bent;
};

class PolygonTrianglesProperty : public testing::TestWithParam<Kind> {};

TEST_P(PolygonTrianglesProperty, CoverTheInside) {
  std::mt19937_64 random(21);
  const auto whole = [&random] { return static_cast<double>(random() % 7) - 3.0; };
  int bridged = 0, concave = 0;
  for (int round = 0; bridged < 1000; ++round) {
    SCOPED_TRACE("round " + std::to_string(round));
    const test::RandomPolygon polygon = test::make_random_polygon(random, GetParam().slits, GetParam().bent);
    Vec3 u(0.0), v(0.0);
    while (glm::cross(u, v) == Vec3(0.0)) u = {whole(), whole(), whole()}, v = {whole(), whole(), whole()};
    std::vector<Vec3> corners;
    for (const Vec2& p : polygon.line) corners.push_back(p.x * u + p.y * v + Vec3(1000, -5, 7));
    const PolygonTriangles divided = divide_polygon(corners);
    expect_divided(corners, divided, glm::cross(u, v), polygon.double_area);
    EXPECT_FALSE(divided.crosses_itself);
    bridged += polygon.has_bridges;
    concave += divided.is_concave;
    if (HasFailure()) return;
  }
  EXPECT_GT(concave, 900);
}

INSTANTIATE_TEST_SUITE_P(Kinds, PolygonTrianglesProperty,
                         testing::Values(Kind{false, true}, Kind{false, false}, Kind{true, true},
                                         Kind{true, false}));

TEST(PolygonTrianglesProperty, RoundedPolygonsHaveTheirArea) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int round = 0; round < 1000; ++round) {
    // Star-shaped about the origin, then somewhere and some size.
    const std::size_t size = 4 + random() % 60;
    const double scale = std::pow(10.0, 20.0 * unit(random) - 10.0);
    const Vec3 u(unit(random), unit(random), -1.0), v(1.0, unit(random), unit(random)), o(3, -2, 1);
    std::vector<Vec3> corners;
    for (std::size_t i = 0; i < size; ++i) {
      const double angle = 2 * 3.14159265358979 * static_cast<double>(i) / static_cast<double>(size);
      const double radius = 0.1 + unit(random);
      corners.push_back(scale * (radius * std::cos(angle) * u + radius * std::sin(angle) * v + o));
    }
    Vec3 expected(0.0), found(0.0);
    double size_of_parts = 0.0;
    for (std::size_t i = 2; i < size; ++i)
      expected += glm::cross(corners[i - 1] - corners[0], corners[i] - corners[0]);
    const PolygonTriangles divided = divide_polygon(corners);
    for (const auto& [a, b, c] : divided.triangles) {
      const Vec3 part = glm::cross(corners[b] - corners[a], corners[c] - corners[a]);
      found += part;
      size_of_parts += glm::length(part);
    }
    EXPECT_EQ(divided.triangles.size(), size - 2);
    EXPECT_FALSE(divided.crosses_itself);
    EXPECT_NEAR(glm::length(found - expected) / glm::length(expected), 0.0, 1e-12) << round;
    EXPECT_NEAR(size_of_parts / glm::length(expected), 1.0, 1e-12) << round;
  }
}

}  // namespace
}  // namespace penumbra
