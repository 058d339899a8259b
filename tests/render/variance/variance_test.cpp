// The method variance: exact for what Chebyshev's bound is exact for, a flat blocker and floor parallel to a rectangle.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "penumbra/mesh/error.h"
#include "penumbra/render/visibility.h"
#include "tests/render/render_support.h"

namespace penumbra {
namespace {

using testing::Values;

Values seen(const std::vector<TriangleMesh>& casters, const LightShape& light, const Receivers& receivers,
            const OptionValues& options = {}) {
  return visibility(Casters(casters), light, receivers, {.method = "variance", .options = options})
      .visibility;
}

const DiskLight kUnit{Vec3(0.0), {0, 0, 1}, 1.0};

/// A floor at height 2 in the light's frame.
struct Floor {
  explicit Floor(double low, double high) {
    for (double x = low; x < high; x += 0.05) points.emplace_back(x, 0.3, 2.0);
    normals.assign(points.size(), {0, 0, -1});
  }
  Receivers receivers() const { return {.points = points, .normals = normals}; }
  std::vector<Vec3> points, normals;
};

// A window holds two depths only: the bound is then the share of the deeper one, whatever the warp.
TEST(Variance, IsExactForAFlatBlockerParallelToARectangle) {
  const Floor floor(-1.4, 1.4);
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
  const Values of_disk = seen(sheet, kUnit, floor.receivers());
  for (std::size_t i = 0; i < of_disk.size(); ++i)
    EXPECT_NEAR(of_disk[i], half_plane_area(-floor.points[i].x), 0.04) << floor.points[i].x;
}

// Two layers: light leaks into the umbra of the lower one, less with a warp, and not at all with a cut.
TEST(Variance, LeaksLightWhereDepthsVary) {
  const std::vector<TriangleMesh> plates{testing::rectangle(-0.5, 0.0, -3, 3, 0.4),
                                         testing::rectangle(-3, 3, -3, 3, 1.5)};
  const std::vector<Vec3> points{{0, 0, 2}}, normals{{0, 0, -1}};
  const Receivers receivers{.points = points, .normals = normals};
  EXPECT_EQ(visibility(Casters(plates), kUnit, receivers).visibility[0], 0.0f) << "umbra";
  const float plain = seen(plates, kUnit, receivers, {{"depth-warp", 0.0}})[0],
              warped = seen(plates, kUnit, receivers, {{"depth-warp", 15.0}})[0],
              cut = seen(plates, kUnit, receivers, {{"depth-warp", 0.0}, {"leak-cut", 0.8}})[0];
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
  const std::vector<Vec3> points{{0, 0.3, 2}, {0.1, 0.3, 2}, {0, 0, -1}};
  const std::vector<std::int32_t> objects{-1, 0, 0};
  EXPECT_EQ(seen({}, kUnit, {.points = points}), (Values{1, 1, 0})) << "the last is behind the light";
  EXPECT_TRUE(seen({}, kUnit, {}).empty());
  const Values below =
      seen({testing::rectangle(-60, 60, -60, 60, 1.0)}, kUnit, {.points = points, .objects = objects});
  EXPECT_EQ(below[0], 1.0f) << "no receiver";
  EXPECT_LT(below[1], 1e-3f);
  EXPECT_EQ(below[2], 0.0f);
  testing::Random random(3);
  std::vector<Vec3> around;
  for (int i = 0; i < 2'000; ++i) around.push_back(random.point(4.0));
  const std::vector<TriangleMesh> box{make_box(Vec3(0.0), {1, 1, 1})};
  for (const LightShape& light :
       {LightShape(DiskLight{{0, 0.3, 0}, {0.2, -1, 0.1}, 0.4}),
        LightShape(DiskLight{{0.9, 0.2, 0.1}, {0.3, -1, 0}, 0.5}),
        LightShape(DiskLight{{0, 1e9, 0}, {0, -1, 0}, 1e8}),
        LightShape(DiskLight{{0, 3, 0}, {0, -1, 0}, 30.0}), LightShape(DistantLight{{0.3, -1, 0.2}, 170.0})})
    for (const float v : seen(box, light, {.points = around}, {{"map-size", std::uint64_t{256}}}))
      EXPECT_TRUE(v >= 0.0f && v <= 1.0f) << v;
  for (const OptionValue& bad : {OptionValue(-1.0), OptionValue(100.0), OptionValue("many")})
    for (const char* option : {"map-size", "depth-warp", "leak-cut"})
      EXPECT_THROW(seen({}, kUnit, {.points = points}, {{option, bad}}), UsageError);
}

}  // namespace
}  // namespace penumbra
