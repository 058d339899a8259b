// The method variance: exact for what Chebyshev's bound is exact for, a flat blocker and floor parallel to a
// rectangle.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/render/method_support.h"

namespace penumbra {
namespace {

using testing::kUnitDisk;
using testing::MethodUnderTest;
using testing::RowOfReceivers;
using testing::Values;

const MethodUnderTest seen("variance");

// A window holds two depths only: the bound is then the share of the deeper one, whatever the warp.
TEST(Variance, IsExactForAFlatBlockerParallelToARectangle) {
  const RowOfReceivers floor(-1.4, 1.4);
  const std::vector<TriangleMesh> sheet{testing::rectangle(0, 6, -6, 6, 1.0)};
  const RectangleLight light{
      .center = Vec3(0.0), .normal = {0, 0, 1}, .tangent = {1, 0, 0}, .half_extents = {0.5, 1.5}};
  for (const double warp : {0.0, 5.0, 15.0}) {
    const Values values =
        seen(sheet, light, floor.receivers(), {{"map-size", std::uint64_t{2048}}, {"depth-warp", warp}});
    for (std::size_t i = 0; i < values.size(); ++i)
      EXPECT_NEAR(values[i], std::clamp(0.5 - floor.points[i].x, 0.0, 1.0), 0.01)
          << floor.points[i].x << ", warp " << warp;
  }
  // A disk counts as a square of its area: between two chords it is off by up to .03.
  const Values of_disk = seen(sheet, kUnitDisk, floor.receivers());
  for (std::size_t i = 0; i < of_disk.size(); ++i)
    EXPECT_NEAR(of_disk[i], half_plane_area(-floor.points[i].x), 0.04) << floor.points[i].x;
}

// Two layers: light leaks into the umbra of the lower one, less with a warp, and not at all with a cut.
TEST(Variance, LeaksLightWhereDepthsVary) {
  const std::vector<TriangleMesh> plates{testing::rectangle(-0.5, 0.0, -3, 3, 0.4),
                                         testing::rectangle(-3, 3, -3, 3, 1.5)};
  const std::vector<Vec3> points{{0, 0, 2}}, normals{{0, 0, -1}};
  const Receivers receivers{.points = points, .normals = normals};
  EXPECT_EQ(visibility(Casters(plates), kUnitDisk, receivers).visibility[0], 0.0f) << "umbra";
  const float plain = seen(plates, kUnitDisk, receivers, {{"depth-warp", 0.0}})[0],
              warped = seen(plates, kUnitDisk, receivers, {{"depth-warp", 15.0}})[0],
              cut = seen(plates, kUnitDisk, receivers, {{"depth-warp", 0.0}, {"leak-cut", 0.8}})[0];
  EXPECT_GT(plain, 0.1f);
  EXPECT_LT(warped, 0.2f * plain);
  EXPECT_EQ(cut, 0.0f);
}

TEST(Variance, SurfacesThatSeeAllOfTheLightStayLit) {
  const std::vector<TriangleMesh> ball{make_icosphere({0, 0, 0}, 1.0, 4)};
  std::vector<Vec3> points, normals;
  const TriangleMesh& mesh = ball.front();
  for (const IndexedTriangle& t : mesh.triangles()) {
    const Vec3 a = mesh.positions()[t[0]], b = mesh.positions()[t[1]], c = mesh.positions()[t[2]];
    const Vec3 normal = glm::normalize(glm::cross(b - a, c - a));
    if (normal.y < 0.5) continue;
    points.push_back((a + b + c) / 3.0);
    normals.push_back(normal);
  }
  const Values values =
      seen(ball, DiskLight{{0, 6, 0}, {0, -1, 0}, 0.3}, {.points = points, .normals = normals});
  double sum = 0.0;
  for (const float v : values) sum += v;
  EXPECT_GT(sum / static_cast<double>(values.size()), 0.98);
}

TEST(Variance, EmptyScenesBadSettingsAndLightsAnywhere) {
  seen.expect_empty_scenes_are_lit(1e-3f);
  seen.expect_lights_anywhere_do(2'000, {{"map-size", std::uint64_t{256}}});
  seen.expect_are_refused({"map-size", "depth-warp", "leak-cut"}, {-1.0, 100.0, "many"});
}

}  // namespace
}  // namespace penumbra
