// The method pcss: right for what it assumes, a flat blocker parallel to a disk and to a flat receiver.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "tests/render/method_support.h"

namespace penumbra {
namespace {

using testing::kUnitDisk;
using testing::MethodUnderTest;
using testing::RowOfReceivers;
using testing::Values;

const MethodUnderTest seen("pcss");

const OptionValues kMany{{"search-samples", std::uint64_t{1024}},
                         {"filter-samples", std::uint64_t{1024}},
                         {"map-size", std::uint64_t{4096}}};

// One blocker at one depth, parallel to light and floor: the filter's window is the light, seen on the
// blocker's plane.
TEST(Pcss, IsRightForAFlatBlockerParallelToTheLight) {
  const RowOfReceivers floor(-1.4, 1.4);
  const std::vector<TriangleMesh> sheet{testing::rectangle(0, 6, -6, 6, 1.0)};
  const Values values = seen(sheet, kUnitDisk, floor.receivers(), kMany);
  for (std::size_t i = 0; i < values.size(); ++i)
    EXPECT_NEAR(values[i], half_plane_area(-floor.points[i].x), 0.01) << floor.points[i].x;
  const RectangleLight light{
      .center = Vec3(0.0), .normal = {0, 0, 1}, .tangent = {1, 0, 0}, .half_extents = {0.5, 1.5}};
  const Values of_rectangle = seen(sheet, light, floor.receivers(), kMany);
  for (std::size_t i = 0; i < values.size(); ++i)
    EXPECT_NEAR(of_rectangle[i], std::clamp(0.5 - floor.points[i].x, 0.0, 1.0), 0.01) << floor.points[i].x;
}

TEST(Pcss, IsTheSameUnderALightThatRecedes) {
  const std::vector<TriangleMesh> box{make_box({0, 1, 0}, {0.5, 0.5, 0.5})};
  std::vector<Vec3> points;
  for (int i = 0; i < 40; ++i)
    for (int k = 0; k < 40; ++k) points.emplace_back(0.05 * i - 1.0, 0.0, 0.05 * k - 1.0);
  const std::vector<Vec3> normals(points.size(), {0, 1, 0});
  const Receivers receivers{.points = points, .normals = normals};
  const double tangent = 0.2;
  const Values distant =
      seen(box, DistantLight{{0, -1, 0}, 2.0 * std::atan(tangent) * 180.0 / testing::kPi}, receivers);
  double before = 1.0;
  for (const double distance : {1e2, 1e4, 1e8}) {
    const Values near = seen(box, DiskLight{{0, distance, 0}, {0, -1, 0}, tangent * distance}, receivers);
    double most = 0.0, sum = 0.0;
    for (std::size_t i = 0; i < near.size(); ++i) {
      most = std::max(most, double{std::abs(near[i] - distant[i])});
      sum += std::abs(near[i] - distant[i]);
    }
    std::printf("%g away: %.4f in the mean, %.4f at most\n", distance, sum / static_cast<double>(near.size()),
                most);
    EXPECT_LE(sum / static_cast<double>(near.size()), before);
    before = sum / static_cast<double>(near.size()) + 1e-3;
  }
  EXPECT_LT(before, 3e-3);
}

// What the biases are for: a sphere does not shadow its own lit side; without any it does.
TEST(Pcss, BiasesKeepSurfacesFromShadowingThemselves) {
  const std::vector<TriangleMesh> ball{make_icosphere({0, 0, 0}, 1.0, 4)};
  const DiskLight light{{0, 6, 0}, {0, -1, 0}, 0.3};
  std::vector<Vec3> points, normals;
  const TriangleMesh& mesh = ball.front();
  for (const IndexedTriangle& t : mesh.triangles()) {
    const Vec3 a = mesh.positions()[t[0]], b = mesh.positions()[t[1]], c = mesh.positions()[t[2]];
    const Vec3 normal = glm::normalize(glm::cross(b - a, c - a));
    if (normal.y < 0.5) continue;
    points.push_back((a + b + c) / 3.0);
    normals.push_back(normal);
  }
  const Receivers receivers{.points = points, .normals = normals};
  const auto mean = [&](const OptionValues& options) {
    const Values values = seen(ball, light, receivers, options);
    double sum = 0.0;
    for (const float v : values) sum += v;
    return sum / static_cast<double>(values.size());
  };
  EXPECT_GT(mean({}), 0.999);
  EXPECT_LT(mean({{"map-bias", 0.0}, {"slope-bias", 0.0}}), 0.95);
  EXPECT_LT(mean({{"receiver-plane", std::string("off")}, {"map-bias", 0.0}, {"slope-bias", 0.0}}), 0.95);
}

// What it gets wrong by design: a blocker that hides nothing from the receiver counts where it is nearer to
// the light.
TEST(Pcss, SeesOneSurfaceATexel) {
  // A small plate close to the light hides a large one below from the map, but not the light from the
  // receiver.
  const std::vector<TriangleMesh> plates{testing::rectangle(-0.2, 0.2, -0.2, 0.2, 0.2),
                                         testing::rectangle(-1.5, 1.5, -1.5, 1.5, 1.8)};
  const std::vector<Vec3> points{{0, 0, 2}}, normals{{0, 0, -1}};
  const Receivers receivers{.points = points, .normals = normals};
  EXPECT_EQ(visibility(Casters(plates), kUnitDisk, receivers).visibility[0], 0.0f) << "umbra";
  EXPECT_GT(seen(plates, kUnitDisk, receivers)[0], 0.02f) << "a leak";
}

TEST(Pcss, EmptyScenesBadSettingsAndLightsAnywhere) {
  seen.expect_empty_scenes_are_lit();
  seen.expect_lights_anywhere_do(2'000);
  seen.expect_are_refused({"map-size", "search-samples", "filter-samples"}, {std::uint64_t{0}, "many"});
  seen.expect_are_refused({"map-bias"}, {-1.0});
}

}  // namespace
}  // namespace penumbra
