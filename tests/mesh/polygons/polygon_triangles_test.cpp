#include "mesh/polygons/polygon_triangles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>

#include "mesh/polygons/orientation.h"

namespace penumbra {
namespace {

using detail::divide_polygon;
using detail::orientation;
using detail::PolygonTriangles;

double area_of(const std::vector<Vec3>& corners, const PolygonTriangles& divided) {
  double area = 0.0;
  for (const auto& [a, b, c] : divided.triangles)
    area += 0.5 * glm::length(glm::cross(corners[b] - corners[a], corners[c] - corners[a]));
  return area;
}

/// From whichever corner, in either direction.
void expect_area_from_any_corner(std::vector<Vec3> corners, double area) {
  for (std::size_t turned = 0; turned < 2 * corners.size(); ++turned) {
    const PolygonTriangles divided = divide_polygon(corners);
    EXPECT_DOUBLE_EQ(area_of(corners, divided), area) << turned;
    EXPECT_TRUE(divided.is_concave);
    EXPECT_FALSE(divided.crosses_itself);
    std::ranges::rotate(corners, corners.begin() + 1);
    if (turned + 1 == corners.size()) std::ranges::reverse(corners);
  }
}

std::vector<IndexedTriangle> fan(std::uint32_t size) {
  std::vector<IndexedTriangle> triangles;
  for (std::uint32_t k = 2; k < size; ++k) triangles.push_back({0, k - 1, k});
  return triangles;
}

TEST(Orientation, TellsOneUlpFromNothing) {
  const double next = std::nextafter(0.5, 1.0);
  EXPECT_EQ(orientation({0.5, 0.5}, {12, 12}, {24, 24}), 0);
  EXPECT_EQ(orientation({0.5, next}, {12, 12}, {24, 24}), 1);
  EXPECT_EQ(orientation({next, 0.5}, {12, 12}, {24, 24}), -1);
  EXPECT_EQ(orientation({0.1, 0.1}, {0.2, 0.2}, {0.3, 0.3}), 0);
}

TEST(PolygonTriangles, ConcavePolygonsFromAnyCorner) {
  expect_area_from_any_corner({{0, 0, 0}, {3, 0, 0}, {3, 0, 1}, {1, 0, 1}, {1, 0, 4}, {0, 0, 4}}, 6);
  expect_area_from_any_corner({{0, 0, 0}, {2, 0, 1}, {0, 0, 2}, {.5, 0, 1}}, 1.5);
  expect_area_from_any_corner({{0, 0, 0},
                               {5, 0, 0},
                               {5, 0, 4},
                               {4, 0, 4},
                               {4, 0, 1},
                               {3, 0, 1},
                               {3, 0, 4},
                               {2, 0, 4},
                               {2, 0, 1},
                               {1, 0, 1},
                               {1, 0, 4},
                               {0, 0, 4}},
                              14);
}

TEST(PolygonTriangles, HoleJoinedByABridge) {
  expect_area_from_any_corner({{0, 0, 0},
                               {5, 0, 0},
                               {5, 0, 5},
                               {0, 0, 5},
                               {0, 0, 0},
                               {1, 0, 1},
                               {1, 0, 2},
                               {2, 0, 2},
                               {2, 0, 1},
                               {1, 0, 1}},
                              24);
}

TEST(PolygonTriangles, HoleThatTouchesTheMiddleOfASide) {
  // The side from (0,0) to (4,0) passes the hole's corner (2,0).
  const std::vector<Vec3> corners = {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {2, 0, 0}, {1, 3, 0},
                                     {3, 3, 0}, {2, 0, 0}, {4, 4, 0}, {0, 4, 0}};
  const PolygonTriangles divided = divide_polygon(corners);
  EXPECT_DOUBLE_EQ(area_of(corners, divided), 16.0 - 3.0);
  int along_side = 0;
  for (const IndexedTriangle& t : divided.triangles)
    for (std::size_t k = 0; k < 3; ++k) along_side += t[k] == 0 && t[(k + 1) % 3] == 1;
  EXPECT_EQ(along_side, 1) << "a neighbor along the whole side stays a neighbor";
}

TEST(PolygonTriangles, ConvexOnesAreFans) {
  std::vector<Vec3> corners;
  for (int i = 0; i < 12; ++i) corners.emplace_back(std::cos(i * 0.5), 0.25 * i, std::sin(i * 0.5));
  EXPECT_EQ(divide_polygon(corners).triangles, fan(12)) << "a helix, convex from above";
  const std::vector<Vec3> on_sides = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 2, 0}, {1, 2, 0}, {0, 2, 0}};
  EXPECT_EQ(divide_polygon(on_sides).triangles, fan(6));
  EXPECT_FALSE(divide_polygon(on_sides).is_concave);
  const std::vector<Vec3> repeated = {{0, 0, 0}, {0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {2, 2, 0}, {0, 0, 0}};
  EXPECT_EQ(divide_polygon(repeated).triangles, fan(6));
  EXPECT_FALSE(divide_polygon(repeated).is_concave);
  const std::vector<Vec3> warped = {{0, 0, 0}, {1, 0, .3}, {1, 1, 0}, {0, 1, .3}};
  EXPECT_EQ(divide_polygon(warped).triangles, fan(4));
}

TEST(PolygonTriangles, AtAnyScale) {
  for (const double scale : {1e-300, 1e-30, 1e30, 1e300}) {
    std::vector<Vec3> corners = {{0, 0, 0}, {3, 0, 0}, {3, 0, 1}, {1, 0, 1}, {1, 0, 4}, {0, 0, 4}};
    std::ranges::rotate(corners, corners.begin() + 1);
    const std::vector<IndexedTriangle> expected = divide_polygon(corners).triangles;
    for (Vec3& p : corners) p *= scale;
    EXPECT_EQ(divide_polygon(corners).triangles, expected) << scale;
  }
}

// Products of these coordinates underflow: no sign of a turn is known.
TEST(PolygonTriangles, CornersFarCloserThanOthersEndInAFan) {
  const std::vector<Vec3> corners = {{0, 0, 0}, {1e-200, 0, 0}, {0, 1e-200, 0}, {-1, 1, 0}, {0.5, 1, 0}};
  EXPECT_EQ(divide_polygon(corners).triangles.size(), 3u);
}

TEST(PolygonTriangles, CrossingAndDegenerateOnesAreFans) {
  const std::vector<Vec3> bow_tie = {{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}};
  EXPECT_EQ(divide_polygon(bow_tie).triangles, fan(4));
  EXPECT_TRUE(divide_polygon(bow_tie).crosses_itself);
  std::vector<Vec3> star;
  for (int i = 0; i < 5; ++i) star.emplace_back(std::cos(2.513274123 * i), std::sin(2.513274123 * i), 1);
  EXPECT_TRUE(divide_polygon(star).crosses_itself);
  const std::vector<Vec3> twice = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  EXPECT_TRUE(divide_polygon(twice).crosses_itself);
  const std::vector<Vec3> on_a_line = {{0, 0, 0}, {1, 1, 1}, {3, 3, 3}, {2, 2, 2}};
  EXPECT_EQ(divide_polygon(on_a_line).triangles, fan(4));
  EXPECT_FALSE(divide_polygon(on_a_line).crosses_itself);
  EXPECT_FALSE(divide_polygon(on_a_line).is_concave);
  EXPECT_EQ(divide_polygon(std::vector<Vec3>(4, Vec3(1.0))).triangles, fan(4));
  EXPECT_TRUE(divide_polygon(std::vector<Vec3>(2)).triangles.empty());
}

TEST(PolygonTriangles, ManyCornersTakeNoTimeSquared) {
  // A comb of 100,000 corners: rays and walks across it are as long as they can be.
  std::vector<Vec3> comb;
  constexpr int kTeeth = 25000;
  for (int i = 0; i < kTeeth; ++i) {
    comb.insert(comb.end(), {{2 * i, 1, 0}, {2 * i, 9, 0}, {2 * i + 1, 9, 0}, {2 * i + 1, 1, 0}});
  }
  comb.insert(comb.end(), {{2 * kTeeth, 1, 0}, {2 * kTeeth, 0, 0}, {0, 0, 0}});
  const auto start = std::chrono::steady_clock::now();
  const PolygonTriangles divided = divide_polygon(comb);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(10));
  EXPECT_DOUBLE_EQ(area_of(comb, divided), 2.0 * kTeeth + 8.0 * kTeeth);
}

}  // namespace
}  // namespace penumbra
