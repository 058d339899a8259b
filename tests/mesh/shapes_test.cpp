#include "penumbra/mesh/shapes.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <numbers>

#include "tests/mesh/mesh_samples.h"

namespace penumbra {
namespace {

using std::numbers::pi;
using test::euler_characteristic;

void expect_closed_and_outward(const TriangleMesh& mesh, double volume, double tolerance) {
  test::expect_sound(mesh);
  EXPECT_TRUE(mesh.is_closed());
  ASSERT_EQ(mesh.components().size(), 1u);
  EXPECT_NEAR(mesh.components()[0].signed_volume, volume, tolerance * volume);
  const BuildReport& report = mesh.report();
  EXPECT_EQ(report.flipped_components, 0u) << "made outward, not turned so";
  EXPECT_EQ(report.welded_vertices + report.split_vertices + report.unused_vertices, 0u);
  EXPECT_TRUE(report.zero_area.empty());
}

TEST(Shapes, Box) {
  const TriangleMesh box = make_box({1, 2, 3}, {0.5, 1, 2});
  expect_closed_and_outward(box, 8.0, 1e-12);
  EXPECT_EQ(euler_characteristic(box), 2);
  const Bounds bounds = bounds_of(box.positions());
  EXPECT_EQ(bounds.low, Vec3(0.5, 1, 1));
  EXPECT_EQ(bounds.high, Vec3(1.5, 3, 5));
}

TEST(Shapes, Icosphere) {
  for (int levels = 0; levels <= 5; ++levels) {
    const TriangleMesh sphere = make_icosphere({5, 0, -1}, 2.0, levels);
    EXPECT_EQ(sphere.triangles().size(), 20u << (2 * levels));
    EXPECT_EQ(euler_characteristic(sphere), 2);
    const double inscribed_error = 0.6 / (1 << (2 * levels));  // falls with the square of the edges' length
    expect_closed_and_outward(sphere, 4.0 / 3.0 * pi * 8.0, inscribed_error);
    for (const Vec3& p : sphere.positions()) {
      EXPECT_NEAR(glm::length(p - Vec3(5, 0, -1)), 2.0, 1e-14);
    }
  }
}

TEST(Shapes, Torus) {
  const TriangleMesh torus = make_torus({1, 1, 1}, 2.0, 0.5, 96, 48);
  EXPECT_EQ(torus.triangles().size(), 2u * 96 * 48);
  EXPECT_EQ(euler_characteristic(torus), 0);
  expect_closed_and_outward(torus, 2 * pi * pi * 2.0 * 0.25, 0.005);
  EXPECT_TRUE(make_torus({0, 0, 0}, 1, 0.4, 3, 3).is_closed());
}

TEST(Shapes, Cylinder) {
  const TriangleMesh cylinder = make_cylinder({0, -3, 0}, 0.5, 2.0, 128);
  EXPECT_EQ(cylinder.triangles().size(), 4u * 128);
  EXPECT_EQ(euler_characteristic(cylinder), 2);
  expect_closed_and_outward(cylinder, pi * 0.25 * 4.0, 0.001);
  EXPECT_TRUE(make_cylinder({0, 0, 0}, 1, 1, 3).is_closed());
}

TEST(Shapes, PlaneFacesUp) {
  const TriangleMesh plane = make_plane(2.0, 3);
  test::expect_sound(plane);
  EXPECT_EQ(plane.triangles().size(), 18u);
  EXPECT_EQ(euler_characteristic(plane), 1);
  EXPECT_EQ(test::boundary_edge_count(plane), 12u);
  double area = 0.0;
  for (const auto& [a, b, c] : plane.triangles()) {
    const Vec3 n =
        glm::cross(plane.positions()[b] - plane.positions()[a], plane.positions()[c] - plane.positions()[a]);
    EXPECT_GT(n.y, 0.0);
    EXPECT_EQ(n.x, 0.0);
    area += 0.5 * n.y;
  }
  EXPECT_DOUBLE_EQ(area, 16.0);
}

TEST(Shapes, Triangle) {
  const TriangleMesh triangle = make_triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  ASSERT_EQ(triangle.triangles().size(), 1u);
  EXPECT_EQ(triangle.position(VertexId{1}), Vec3(1, 0, 0));
}

TEST(Shapes, RandomTrianglesAreTheSameEverywhere) {
  const TriangleMesh foliage = make_random_triangles({1, 2, 3}, 1.3, 0.25, 200, 7);
  test::expect_sound(foliage);
  EXPECT_EQ(foliage.triangles().size(), 200u);
  EXPECT_EQ(foliage.components().size(), 200u);
  const TriangleMesh again = make_random_triangles({1, 2, 3}, 1.3, 0.25, 200, 7);
  EXPECT_TRUE(std::ranges::equal(foliage.positions(), again.positions()));
  const TriangleMesh other = make_random_triangles({1, 2, 3}, 1.3, 0.25, 200, 8);
  EXPECT_FALSE(std::ranges::equal(foliage.positions(), other.positions()));
  for (const Vec3& p : foliage.positions()) {
    EXPECT_LE(glm::length(p - Vec3(1, 2, 3)), 1.3 + 0.25);
  }
  const Vec3 first = make_random_triangles({0, 0, 0}, 1, 1, 1, 1).positions()[0];
  EXPECT_EQ(first, Vec3(0.21196670160793696, -1.6722435325683578, 0.25205209564895315));
}

}  // namespace
}  // namespace penumbra
