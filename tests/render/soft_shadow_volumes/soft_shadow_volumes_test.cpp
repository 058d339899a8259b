// The method soft-shadow-volumes: exact where one silhouette serves the whole light, and wrong where overlap
// is added.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "tests/render/method_support.h"

namespace penumbra {
namespace {

using testing::kUnitDisk;
using testing::Random;
using testing::Values;

const testing::MethodUnderTest method("soft-shadow-volumes");

Values seen(const std::vector<TriangleMesh>& casters, const LightShape& light, const Receivers& receivers,
            std::uint64_t splits = 1) {
  return method(casters, light, receivers, {{"light-splits", splits}});
}

Values exact(const std::vector<TriangleMesh>& casters, const LightShape& light, const Receivers& receivers) {
  return testing::MethodUnderTest("silhouette")(casters, light, receivers, {{"silhouette-tolerance", 0.0}});
}

/// Receivers at height 2 in a row; the edge of `sheet_from(0)` is projected to twice its place less that of
/// the receiver.
std::vector<Vec3> row(double low, double high) {
  std::vector<Vec3> points;
  for (double x = low; x < high; x += 0.05) points.emplace_back(x, 0.3, 2.0);
  return points;
}
TriangleMesh sheet_from(double x) {
  return testing::rectangle(x, x + 60, -60, 60, 1.0);
}

TEST(SoftShadowVolumes, AreExactBesideAnEdge) {
  // For one receiver the edge runs through the light's center, and along a border of patches.
  const std::vector<Vec3> points = row(-1.2, 1.2);
  for (const std::uint64_t splits : {1, 2, 3, 8}) {
    const Values values = seen({sheet_from(0.0)}, kUnitDisk, {.points = points}, splits);
    for (std::size_t i = 0; i < points.size(); ++i)
      EXPECT_NEAR(values[i], half_plane_area(-points[i].x), 1e-6) << points[i].x << ", " << splits;
  }
}

TEST(SoftShadowVolumes, OfRectanglesAreExactBesideAnEdge) {
  const std::vector<Vec3> points = row(-0.9, 0.9);
  const RectangleLight light{
      .center = Vec3(0.0), .normal = {0, 0, 1}, .tangent = {1, 0, 0}, .half_extents = {0.5, 1.5}};
  for (const std::uint64_t splits : {1, 3}) {
    const Values values = seen({sheet_from(0.0)}, light, {.points = points}, splits);
    for (std::size_t i = 0; i < points.size(); ++i)
      EXPECT_NEAR(values[i], std::clamp(0.5 - points[i].x, 0.0, 1.0), 1e-6) << points[i].x << ", " << splits;
  }
}

// A flat convex caster, and a box under a light that is narrower than its top: all of the light sees one
// silhouette.
TEST(SoftShadowVolumes, AreExactForOneConvexCasterWithOneSilhouette) {
  Random random(5);
  const std::vector<TriangleMesh> triangle{
      make_triangle({-0.8, -0.5, 1.1}, {0.8, -0.4, 0.9}, {0.1, 0.9, 1.0})};
  const std::vector<TriangleMesh> box{make_box({0.1, 0.0, 1.6}, {1.2, 1.3, 0.4})};
  std::vector<Vec3> points, normals;
  for (int i = 0; i < 4'000; ++i) {
    points.emplace_back(random.uniform(-2.5, 2.5), random.uniform(-2.5, 2.5), random.uniform(2.1, 4.0));
    const Vec3 lean(random.uniform(-3, 3), random.uniform(-3, 3), -1.0);
    normals.push_back(glm::normalize(lean));
  }
  for (const std::vector<TriangleMesh>& casters : {triangle, box})
    for (const bool with_normals : {false, true})
      for (const std::uint64_t splits : {1, 3}) {
        Receivers receivers{.points = points};
        if (with_normals) receivers.normals = normals;
        const Values ours = seen(casters, kUnitDisk, receivers, splits),
                     truth = exact(casters, kUnitDisk, receivers);
        std::size_t partly = 0;
        double most = 0.0;
        for (std::size_t i = 0; i < points.size(); ++i) {
          partly += truth[i] > 0.0f && truth[i] < 1.0f;
          most = std::max(most, double{std::abs(ours[i] - truth[i])});
        }
        EXPECT_GT(partly, 500u);
        // Where a horizon leaves a sliver of a cell, it counts as lit.
        EXPECT_LE(most, with_normals && splits > 1 ? 1e-4 : 1e-5)
            << (with_normals ? "with" : "without") << " horizons, " << splits << " splits";
      }
}

// Two sheets that hide the same half hide all of the light: what layers hide is added.
TEST(SoftShadowVolumes, AddOverlap) {
  const std::vector<TriangleMesh> two{sheet_from(0.0), testing::rectangle(0.0, 60, -60, 60, 1.00001)};
  const std::vector<Vec3> points = row(-0.9, 0.9);
  const Values ours = seen(two, kUnitDisk, {.points = points});
  for (std::size_t i = 0; i < points.size(); ++i)
    EXPECT_NEAR(ours[i], std::max(0.0, 2.0 * half_plane_area(-points[i].x) - 1.0), 1e-4) << points[i].x;
  const std::vector<Vec3> middle{{0.0, 0.3, 2.0}};
  EXPECT_NEAR(exact(two, kUnitDisk, {.points = middle})[0], 0.5, 1e-4);
  EXPECT_NEAR(seen(two, kUnitDisk, {.points = middle}, 8)[0], 0.5, 0.1) << "patches are lit, or hidden twice";
}

double rmse(const Values& a, const Values& truth) {
  double sum = 0.0;
  std::size_t partly = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (!(truth[i] > 0.0f && truth[i] < 1.0f)) continue;
    sum += (a[i] - truth[i]) * (a[i] - truth[i]);
    ++partly;
  }
  return std::sqrt(sum / static_cast<double>(partly));
}

TEST(SoftShadowVolumes, OfMorePatchesAreCloserToTheTruth) {
  for (const char* name : {"torus-large", "boxes-medium"}) {
    const Scene scene = testing::data_scene(name);
    const SurfaceBuffer surface = make_surface_buffer(scene, RayScene(scene, 0), 160, 120);
    const Casters casters(scene.objects);
    const LightShape& light = scene.lights.front().shape;
    const Values truth = visibility(casters, light, surface.receivers()).visibility;
    double before = 1.0;
    for (const std::uint64_t splits : {1, 2, 4}) {
      const double error =
          rmse(visibility(casters, light, surface.receivers(),
                          {.method = "soft-shadow-volumes", .options = {{"light-splits", splits}}})
                   .visibility,
               truth);
      std::printf("%s, %zu splits: RMSE %.4f\n", name, static_cast<std::size_t>(splits), error);
      EXPECT_LT(error, 0.8 * before) << name << ", " << splits;
      before = error;
    }
  }
}

// A solid hides once, whatever its faces, and so does a solid with a hole on the side that is hidden anyway.
TEST(SoftShadowVolumes, SolidsHideOnce) {
  const TriangleMesh ball = make_icosphere({0, 0, 1.5}, 0.5, 3);
  std::vector<IndexedTriangle> fewer(ball.triangles().begin(), ball.triangles().end() - 3);
  const TriangleMesh with_hole =
      TriangleMesh::build({ball.positions().begin(), ball.positions().end()}, fewer);
  ASSERT_FALSE(with_hole.is_closed());
  // Of a light that is small beside the ball the center's silhouette is nearly that of all points.
  const DiskLight light{Vec3(0.0), {0, 0, 1}, 0.2};
  const std::vector<Vec3> points = row(-2.0, 2.0);
  const Values truth = exact({ball}, light, {.points = points}),
               ours = seen({ball}, light, {.points = points}),
               of_hole = seen({with_hole}, light, {.points = points});
  std::size_t partly = 0;
  double off = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_NEAR(ours[i], truth[i], 0.04) << points[i].x;
    if (!(truth[i] > 0.0f && truth[i] < 1.0f)) continue;
    ++partly;
    off += std::abs(of_hole[i] - truth[i]);
  }
  EXPECT_GT(partly, 4u);
  // Light that falls through the hole is half hidden. Faces that hid one by one would be off by a quarter.
  EXPECT_LT(off / static_cast<double>(partly), 0.05);
}

TEST(SoftShadowVolumes, LightsBehindInsideAndFar) {
  const std::vector<TriangleMesh> box{make_box(Vec3(0.0), {1, 1, 1})};
  Random random(3);
  std::vector<Vec3> around;
  for (int i = 0; i < 1'000; ++i) around.push_back(random.point(4.0));
  for (const LightShape& light :
       {LightShape(DiskLight{{0.9, 0.2, 0.1}, {0.3, -1, 0}, 0.5}),
        LightShape(DiskLight{{0, 3, 0}, {0, -1, 0}, 30.0}),
        LightShape(DiskLight{{0, 3, 0}, {0, -1, 0}, 1e-6}), LightShape(DistantLight{{0.3, -1, 0.2}, 120.0})})
    for (const float v : seen(box, light, {.points = around})) EXPECT_TRUE(v >= 0.0f && v <= 1.0f) << v;
  for (const Vec3& p : around) {
    const double most = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    if (most < 1.05 || p.y > 0.25) continue;
    EXPECT_EQ(seen(box, DiskLight{{0, 0.3, 0}, {0, -1, 0}, 0.4}, {.points = {&p, 1}})[0], 0.0f)
        << "a light inside of a box is hidden by it";
  }
  const std::vector<Vec3> behind{{0, 4, 0}, {0, 5, 0}}, below{{0, -3, 0}, {5, -3, 0}};
  EXPECT_EQ(seen(box, DiskLight{{0, 4, 0}, {0, -1, 0}, 0.5}, {.points = behind}), (Values{0, 0}));
  EXPECT_EQ(seen(box, DiskLight{{0, 4, 0}, {0, -1, 0}, 0.0}, {.points = below}), (Values{0, 1})) << "a point";
  // Askew to the box: of a light straight above, its sides are silhouettes or none by rounding.
  const Vec3 towards = glm::normalize(Vec3(-0.2, 1.0, -0.1));
  const Values far = seen(box, DiskLight{1e8 * towards, -towards, 1e7}, {.points = around});
  const DistantLight sun{-towards, 2.0 * std::atan(0.1) * 180.0 / testing::kPi};
  const Values distant = seen(box, sun, {.points = around});
  for (std::size_t i = 0; i < around.size(); ++i) EXPECT_NEAR(far[i], distant[i], 1e-5) << i;
}

TEST(SoftShadowVolumes, EmptyScenesAndBadSettings) {
  method.expect_empty_scenes_are_lit();
  method.expect_are_refused({"light-splits"}, {std::uint64_t{0}, std::uint64_t{9}, "many"});
}

TEST(SoftShadowVolumes, WithoutTheHorizonIsWithoutNormals) {
  Random random(8);
  std::vector<Vec3> points, normals;
  for (int i = 0; i < 2'000; ++i) {
    points.emplace_back(random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(1.5, 4.0));
    normals.push_back(random.direction());
  }
  const Casters casters(std::vector<TriangleMesh>{sheet_from(0.0)});
  VisibilityOptions options{.method = "soft-shadow-volumes"};
  options.with_unoccluded = true;
  const Values with =
      visibility(casters, kUnitDisk, {.points = points, .normals = normals}, options).unoccluded;
  EXPECT_EQ(with, visibility(casters, kUnitDisk, {.points = points}, options).visibility);
}

}  // namespace
}  // namespace penumbra
