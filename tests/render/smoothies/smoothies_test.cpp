// The method smoothies: hard inside, a smooth step outside of the hard shadow.
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

const MethodUnderTest seen("smoothies");

/// The profile of Parker and others.
double smooth(double t) {
  t = std::clamp(t, 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

// The edge at x = 0 in z = 1: the penumbra in z = 2 reaches from -1 to 1, its outer half from 0 to -1.
TEST(Smoothies, OfAnEdgeAreASmoothStepOutsideOfTheHardShadow) {
  const RowOfReceivers row(-1.42, 1.4);
  const Values values = seen({testing::rectangle(0, 6, -6, 6, 1.0)}, kUnitDisk, row.receivers(),
                             {{"map-size", std::uint64_t{2048}}});
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double x = row.points[i].x;
    EXPECT_NEAR(values[i], smooth(-x), 0.01) << x;
  }
}

// All edges lie at one depth, for which the width is right. At a corner the least of two edges counts, so
// that round corners are as wide as straight ones.
TEST(Smoothies, OfACornerAreRound) {
  const Casters casters(std::vector<TriangleMesh>{testing::rectangle(0, 6, 0, 6, 1.0)});
  std::vector<Vec3> points;
  for (double s = 0.05; s < 1.4; s += 0.05)
    points.emplace_back(-s * std::sqrt(0.5), -s * std::sqrt(0.5), 2.0);
  const std::vector<Vec3> normals(points.size(), {0, 0, -1});
  const Values values = visibility(casters, kUnitDisk, {.points = points, .normals = normals},
                                   {.method = "smoothies", .options = {{"map-size", std::uint64_t{2048}}}})
                            .visibility;
  for (std::size_t i = 0; i < values.size(); ++i)
    EXPECT_NEAR(values[i], smooth(std::hypot(points[i].x, points[i].y)), 0.01) << i;
}

// One width for all edges is right for one depth: with edges at two depths both penumbras are wrong, by the
// ratio of depths.
TEST(Smoothies, HaveOneWidthForAllDepths) {
  // Squares far apart, at depths 1 and 1.5.
  const std::vector<TriangleMesh> two{testing::rectangle(0, 1, -1, 1, 1.0),
                                      testing::rectangle(20, 21.5, -1.5, 1.5, 1.5)};
  const std::vector<Vec3> points{{-0.5, 0, 2.0}}, normals{{0, 0, -1}};
  const DiskLight small{Vec3(0.0), {0, 0, 1}, 1.0};
  const Values alone = seen({two.front()}, small, {.points = points, .normals = normals}),
               both = seen(two, small, {.points = points, .normals = normals});
  EXPECT_NEAR(alone[0], smooth(0.5), 0.03);
  EXPECT_GT(both[0], alone[0] + 0.05f) << "too narrow for the nearer one";
}

TEST(Smoothies, EmptyScenesBadSettingsAndLightsAnywhere) {
  seen.expect_empty_scenes_are_lit();
  const std::span<const LightShape> lights = MethodUnderTest::lights_anywhere();
  seen.expect_lights_anywhere_do(2'000, {{"map-size", std::uint64_t{256}}}, lights.first(lights.size() - 1));
  const std::vector<Vec3> points{{0, 0.3, 2}};
  EXPECT_THROW(seen({}, lights.back(), {.points = points}), UsageError) << "distant";
  seen.expect_are_refused({"map-size", "map-bias"}, {-1.0, std::uint64_t{100'000}, "many"});
}

}  // namespace
}  // namespace penumbra
