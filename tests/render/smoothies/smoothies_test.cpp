// The method smoothies: hard inside, a smooth step outside of the hard shadow.
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
  return visibility(Casters(casters), light, receivers, {.method = "smoothies", .options = options})
      .visibility;
}

/// The profile of Parker and others.
double smooth(double t) {
  t = std::clamp(t, 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

const DiskLight kUnit{Vec3(0.0), {0, 0, 1}, 1.0};

/// Receivers at height 2 in the light's frame, on no mesh; normals towards the light.
struct Row {
  Row(double low, double high) {
    for (double x = low; x < high; x += 0.05) points.emplace_back(x, 0.3, 2.0);
    normals.assign(points.size(), {0, 0, -1});
  }
  Receivers receivers() const { return {.points = points, .normals = normals}; }
  std::vector<Vec3> points, normals;
};

// The edge at x = 0 in z = 1: the penumbra in z = 2 reaches from -1 to 1, its outer half from 0 to -1.
TEST(Smoothies, OfAnEdgeAreASmoothStepOutsideOfTheHardShadow) {
  const Row row(-1.42, 1.4);
  const Values values = seen({testing::rectangle(0, 6, -6, 6, 1.0)}, kUnit, row.receivers(),
                             {{"map-size", std::uint64_t{2048}}});
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double x = row.points[i].x;
    EXPECT_NEAR(values[i], smooth(-x), 0.01) << x;
  }
}

// All edges lie at one depth, for which the width is right. At a corner the least of two edges counts, so that round corners are as wide as straight ones.
TEST(Smoothies, OfACornerAreRound) {
  const Casters casters(std::vector<TriangleMesh>{testing::rectangle(0, 6, 0, 6, 1.0)});
  std::vector<Vec3> points;
  for (double s = 0.05; s < 1.4; s += 0.05)
    points.emplace_back(-s * std::sqrt(0.5), -s * std::sqrt(0.5), 2.0);
  const std::vector<Vec3> normals(points.size(), {0, 0, -1});
  const Values values = visibility(casters, kUnit, {.points = points, .normals = normals},
                                   {.method = "smoothies", .options = {{"map-size", std::uint64_t{2048}}}})
                            .visibility;
  for (std::size_t i = 0; i < values.size(); ++i)
    EXPECT_NEAR(values[i], smooth(std::hypot(points[i].x, points[i].y)), 0.01) << i;
}

// One width for all edges is right for one depth: with edges at two depths both penumbrae are wrong, by the ratio of depths.
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
  const std::vector<Vec3> points{{0, 0.3, 2}, {0.1, 0.3, 2}, {0, 0, -1}};
  const std::vector<std::int32_t> objects{-1, 0, 0};
  EXPECT_EQ(seen({}, kUnit, {.points = points}), (Values{1, 1, 0})) << "the last is behind the light";
  EXPECT_TRUE(seen({}, kUnit, {}).empty());
  EXPECT_EQ(seen({testing::rectangle(-60, 60, -60, 60, 1.0)}, kUnit, {.points = points, .objects = objects}),
            (Values{1, 0, 0}));
  testing::Random random(3);
  std::vector<Vec3> around;
  for (int i = 0; i < 2'000; ++i) around.push_back(random.point(4.0));
  const std::vector<TriangleMesh> box{make_box(Vec3(0.0), {1, 1, 1})};
  for (const LightShape& light : {LightShape(DiskLight{{0, 0.3, 0}, {0.2, -1, 0.1}, 0.4}),
                                  LightShape(DiskLight{{0.9, 0.2, 0.1}, {0.3, -1, 0}, 0.5}),
                                  LightShape(DiskLight{{0, 1e9, 0}, {0, -1, 0}, 1e8}),
                                  LightShape(DiskLight{{0, 3, 0}, {0, -1, 0}, 30.0})})
    for (const float v : seen(box, light, {.points = around}, {{"map-size", std::uint64_t{256}}}))
      EXPECT_TRUE(v >= 0.0f && v <= 1.0f) << v;
  EXPECT_THROW(seen(box, DistantLight{{0.3, -1, 0.2}, 1.0}, {.points = around}), UsageError);
  for (const OptionValue& bad : {OptionValue(-1.0), OptionValue(std::uint64_t{100'000}), OptionValue("many")})
    for (const char* option : {"map-size", "map-bias"})
      EXPECT_THROW(seen({}, kUnit, {.points = points}, {{option, bad}}), UsageError);
}

}  // namespace
}  // namespace penumbra
