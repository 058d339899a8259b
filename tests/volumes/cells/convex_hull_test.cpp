#include "volumes/cells/convex_hull.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "penumbra/volumes/predicates/predicates.h"
#include "tests/volumes/random_inputs.h"

namespace penumbra {
namespace {

/// Closed and oriented, Euler characteristic 2, and no point outside, all exactly.
void expect_hull(const std::vector<Vec3>& points, const std::string& what) {
  SCOPED_TRACE(what);
  const auto triangles = detail::convex_hull(points);
  ASSERT_FALSE(triangles.empty());
  std::set<std::pair<std::uint32_t, std::uint32_t>> half_edges;
  std::set<std::uint32_t> vertices;
  for (const IndexedTriangle& t : triangles) {
    for (int i = 0; i < 3; ++i) {
      ASSERT_TRUE(half_edges.insert({t[i], t[(i + 1) % 3]}).second);
      vertices.insert(t[i]);
    }
    for (const Vec3& p : points) {
      ASSERT_NE(orient3d(points[t[0]], points[t[1]], points[t[2]], p), Sign::kPositive);
    }
  }
  for (const auto& [a, b] : half_edges) ASSERT_TRUE(half_edges.count({b, a}));
  ASSERT_EQ(vertices.size() + triangles.size(), half_edges.size() / 2 + 2);
}

TEST(ConvexHull, OfRandomPoints) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    testing::RandomInputs random(seed);
    std::vector<Vec3> points(4 + seed * 8);
    for (Vec3& p : points) p = random.uniform_point();
    expect_hull(points, "seed " + std::to_string(seed));
  }
}

TEST(ConvexHull, OfGridsWithManyCoplanarPoints) {
  for (int n = 2; n <= 6; ++n) {
    std::vector<Vec3> points;
    for (int i = 0; i < n * n * n; ++i) points.push_back(Vec3(i % n, i / n % n, i / n / n));
    expect_hull(points, "grid " + std::to_string(n));
    for (Vec3& p : points)
      p = p / 3.0 + Vec3(0.1 * p.y, 0.7, 0.3 * p.x);  // the same, rounded out of its planes
    expect_hull(points, "sheared grid " + std::to_string(n));
    points.insert(points.end(), points.begin(), points.end());
    expect_hull(points, "doubled grid " + std::to_string(n));
  }
}

TEST(ConvexHull, OfCosphericalAndLatticePoints) {
  for (std::uint64_t seed = 100; seed < 150; ++seed) {
    testing::RandomInputs random(seed);
    std::vector<Vec3> sphere(200), lattice(300);
    for (Vec3& p : sphere) p = random.direction();
    for (Vec3& p : lattice) p = random.lattice_point(3);
    expect_hull(sphere, "sphere, seed " + std::to_string(seed));
    expect_hull(lattice, "lattice, seed " + std::to_string(seed));
  }
}

TEST(ConvexHull, OfNearlyFlatPoints) {
  for (std::uint64_t seed = 200; seed < 250; ++seed) {
    testing::RandomInputs random(seed);
    std::vector<Vec3> points(100);
    for (Vec3& p : points) {
      const double x = random.uniform(-1, 1), y = random.uniform(-1, 1);
      p = {x, y, 0.3 * x + 0.7 * y};  // a plane, as far as rounding lets it
    }
    expect_hull(points, "seed " + std::to_string(seed));
  }
}

TEST(ConvexHull, EmptyWithoutInterior) {
  EXPECT_TRUE(detail::convex_hull({}).empty());
  EXPECT_TRUE(detail::convex_hull(std::vector<Vec3>(9, Vec3(1, 2, 3))).empty());
  std::vector<Vec3> line, plane;
  for (int i = 0; i < 10; ++i) {
    line.push_back(Vec3(i, 2 * i, 3 * i));
    plane.push_back(Vec3(i, i * i, 5));
  }
  EXPECT_TRUE(detail::convex_hull(line).empty());
  EXPECT_TRUE(detail::convex_hull(plane).empty());
}

}  // namespace
}  // namespace penumbra
