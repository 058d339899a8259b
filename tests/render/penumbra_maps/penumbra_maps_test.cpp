// The method penumbra-maps: hard inside, linear outside of the hard shadow.
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

const MethodUnderTest seen("penumbra-maps");

// The edge at x = 0 in z = 1: the penumbra in z = 2 reaches from -1 to 1, its outer half from 0 to -1.
TEST(PenumbraMaps, OfAnEdgeAreLinearOutsideOfTheHardShadow) {
  const RowOfReceivers row(-1.42, 1.4);
  const Values values = seen({testing::rectangle(0, 6, -6, 6, 1.0)}, kUnitDisk, row.receivers(),
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
      visibility(casters, kUnitDisk, {.points = points, .normals = normals},
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
  seen.expect_empty_scenes_are_lit();
  seen.expect_lights_anywhere_do(2'000, {{"map-size", std::uint64_t{256}}});
  seen.expect_are_refused({"map-size", "map-bias"}, {-1.0, std::uint64_t{100'000}, "many"});
}

}  // namespace
}  // namespace penumbra
