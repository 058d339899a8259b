// The method penumbra-maps: hard inside, linear outside of the hard shadow.
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
  return visibility(Casters(casters), light, receivers, {.method = "penumbra-maps", .options = options})
      .visibility;
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
TEST(PenumbraMaps, OfAnEdgeAreLinearOutsideOfTheHardShadow) {
  const Row row(-1.42, 1.4);
  const Values values = seen({testing::rectangle(0, 6, -6, 6, 1.0)}, kUnit, row.receivers(),
                             {{"map-size", std::uint64_t{2048}}});
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double x = row.points[i].x;
    EXPECT_NEAR(values[i], x > 0.0 ? 0.0 : std::min(1.0, -x), 0.01) << x;
  }
}

// At a corner the least of two edges counts, so that round corners are as wide as straight ones.
TEST(PenumbraMaps, OfACornerAreRound) {
  const Casters casters(std::vector<TriangleMesh>{testing::rectangle(0, 6, 0, 6, 1.0)});
  std::vector<Vec3> points;
  for (double s = 0.05; s < 1.4; s += 0.05)
    points.emplace_back(-s * std::sqrt(0.5), -s * std::sqrt(0.5), 2.0);
  const std::vector<Vec3> normals(points.size(), {0, 0, -1});
  const Values values =
      visibility(casters, kUnit, {.points = points, .normals = normals},
                 {.method = "penumbra-maps", .options = {{"map-size", std::uint64_t{2048}}}})
          .visibility;
  for (std::size_t i = 0; i < values.size(); ++i)
    EXPECT_NEAR(values[i], std::min(1.0, std::hypot(points[i].x, points[i].y)), 0.01) << i;
}

// What it gets wrong by design: the inner half of the penumbra is umbra.
TEST(PenumbraMaps, AreTooDarkOnTheWhole) {
  const Scene scene = testing::data_scene("boxes-medium");
  const SurfaceBuffer surface = make_surface_buffer(scene, RayScene(scene, 0), 160, 120);
  const Casters casters(scene.objects);
  const LightShape& light = scene.lights.front().shape;
  const Values truth = visibility(casters, light, surface.receivers()).visibility,
               ours = visibility(casters, light, surface.receivers(), {.method = "penumbra-maps"}).visibility,
               hard = visibility(casters, light, surface.receivers(), {.method = "hard"}).visibility;
  double off = 0.0;
  std::size_t partly = 0, dark = 0, shadowed = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (surface.object[i] != 0) continue;
    shadowed += hard[i] == 0.0f;
    dark += hard[i] == 0.0f && ours[i] == 0.0f;
    if (!(truth[i] > 0.0f && truth[i] < 1.0f)) continue;
    ++partly;
    off += ours[i] - truth[i];
  }
  EXPECT_GT(static_cast<double>(dark), 0.97 * static_cast<double>(shadowed)) << "but for texels";
  EXPECT_LT(off / static_cast<double>(partly), -0.1);
}

TEST(PenumbraMaps, EmptyScenesBadSettingsAndLightsAnywhere) {
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
  for (const LightShape& light :
       {LightShape(DiskLight{{0, 0.3, 0}, {0.2, -1, 0.1}, 0.4}),
        LightShape(DiskLight{{0.9, 0.2, 0.1}, {0.3, -1, 0}, 0.5}),
        LightShape(DiskLight{{0, 1e9, 0}, {0, -1, 0}, 1e8}),
        LightShape(DiskLight{{0, 3, 0}, {0, -1, 0}, 30.0}), LightShape(DistantLight{{0.3, -1, 0.2}, 170.0})})
    for (const float v : seen(box, light, {.points = around}, {{"map-size", std::uint64_t{256}}}))
      EXPECT_TRUE(v >= 0.0f && v <= 1.0f) << v;
  for (const OptionValue& bad : {OptionValue(-1.0), OptionValue(std::uint64_t{100'000}), OptionValue("many")})
    for (const char* option : {"map-size", "map-bias"})
      EXPECT_THROW(seen({}, kUnit, {.points = points}, {{option, bad}}), UsageError);
}

}  // namespace
}  // namespace penumbra
