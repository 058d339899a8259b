// Simplification of surfaces that are larger than one of its boxes.
#include "volumes/solids/simplify/simplify.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <glm/geometric.hpp>

#include "penumbra/mesh/shapes.h"
#include "penumbra/volumes/checks/validate.h"

namespace penumbra::detail {
namespace {

using Side = SimplifyOptions::Side;

IndexedSurface surface_of(const TriangleMesh& mesh) {
  return {{mesh.positions().begin(), mesh.positions().end()},
          {mesh.triangles().begin(), mesh.triangles().end()}};
}

IndexedSurface simplified(const TriangleMesh& mesh, Side side, double tolerance, int threads) {
  const SimplifyOptions options{
      .side = side, .tolerance = tolerance, .box = {Vec3(-9.0), Vec3(9.0)}, .spacing = 0.05};
  tbb::task_arena arena(threads);
  return arena.execute([&] { return simplify(surface_of(mesh), options); });
}

double volume_of(const IndexedSurface& s) {
  return TriangleMesh::build(s.positions, s.triangles).components().front().signed_volume;
}

TEST(Simplify, LargeSurfacesStaySoundOnTheirSideAndAreTheSameOnAnyNumberOfThreads) {
  const TriangleMesh ball = make_icosphere(Vec3(0.1, 0.2, 0.3), 1.0, 6);  // 81,920 triangles
  const double volume = volume_of(surface_of(ball)), tolerance = 0.004;
  for (const Side side : {Side::kInward, Side::kOutward}) {
    const IndexedSurface one = simplified(ball, side, tolerance, 1),
                         two = simplified(ball, side, tolerance, 2);
    EXPECT_EQ(one.positions, two.positions);
    EXPECT_EQ(one.triangles, two.triangles);
    EXPECT_LT(one.triangles.size(), 8'000u);
    const SurfaceFindings f = check_surface(one.positions, one.triangles);
    EXPECT_TRUE(f.closed());
    EXPECT_TRUE(f.self_intersections.empty());
    EXPECT_TRUE(f.bounds_a_volume);
    const double change = volume_of(one) / volume - 1.0;
    EXPECT_GT(side == Side::kOutward ? change : -change, 0.0);
    EXPECT_LT(std::abs(change), 3.1 * tolerance);
    for (const Vec3& p : one.positions)
      EXPECT_LT(std::abs(glm::length(p - Vec3(0.1, 0.2, 0.3)) - 1.0), 2.0 * tolerance);
  }
}

TEST(Simplify, ABentSheetDoesNotMeetItself) {
  // Two layers 0.02 apart, far nearer than their triangles would like to move.
  const TriangleMesh shell = [] {
    const TriangleMesh outer = make_icosphere(Vec3(0.0), 1.0, 5), inner = make_icosphere(Vec3(0.0), 0.98, 5);
    std::vector<Vec3> positions(outer.positions().begin(), outer.positions().end());
    std::vector<IndexedTriangle> triangles(outer.triangles().begin(), outer.triangles().end());
    const auto first = static_cast<std::uint32_t>(positions.size());
    positions.insert(positions.end(), inner.positions().begin(), inner.positions().end());
    for (const IndexedTriangle& t : inner.triangles())
      triangles.push_back({t[0] + first, t[2] + first, t[1] + first});
    return TriangleMesh::build(positions, triangles, {.flip_inside_out = false});
  }();
  const IndexedSurface out = simplified(shell, Side::kInward, 0.1, 2);
  const SurfaceFindings f = check_surface(out.positions, out.triangles);
  EXPECT_LT(out.triangles.size(), shell.triangles().size() / 4);
  EXPECT_TRUE(f.closed());
  EXPECT_TRUE(f.self_intersections.empty());
}

}  // namespace
}  // namespace penumbra::detail
