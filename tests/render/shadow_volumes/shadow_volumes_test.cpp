// The method shadow-volumes: the picture of `hard`, whatever the casters and wherever the light.
#include <gtest/gtest.h>

#include <cstdio>

#include "tests/render/method_support.h"

namespace penumbra {
namespace {

using testing::Random;
using testing::Values;

MethodResult result(const Casters& casters, const LightShape& light, const Receivers& receivers,
                    const OptionValues& options = {}, bool with_unoccluded = false) {
  return visibility(casters, light, receivers,
                    {.method = "shadow-volumes", .options = options, .with_unoccluded = with_unoccluded});
}

struct Difference {
  std::size_t shadowed = 0, lit = 0, differ = 0;
};
Difference from_hard(const Casters& casters, const LightShape& light, const Receivers& receivers,
                     bool with_unoccluded = false) {
  const MethodResult ours = result(casters, light, receivers, {}, with_unoccluded),
                     hard = visibility(casters, light, receivers,
                                       {.method = "hard", .with_unoccluded = with_unoccluded});
  const Values &a = with_unoccluded ? ours.unoccluded : ours.visibility,
               &b = with_unoccluded ? hard.unoccluded : hard.visibility;
  Difference out;
  EXPECT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (!receivers.is_present(i)) continue;
    ++(b[i] == 0.0f ? out.shadowed : out.lit);
    out.differ += a[i] != b[i];
  }
  return out;
}

/// Rays in float may pass an edge within 1e-7 on the other side.
void expect_hard(const Difference& off, const std::string& name) {
  std::printf("%-24s %6zu in shadow, %6zu lit, %zu differ\n", name.c_str(), off.shadowed, off.lit,
              off.differ);
  EXPECT_LE(off.differ, (off.shadowed + off.lit) / 10'000) << name;
}

TEST(ShadowVolumes, AreTheHardShadow) {
  for (const char* name : {"cube-medium", "torus-large", "boxes-large", "foliage-small", "bunny-medium",
                           "knot1-large", "decorativePlant-medium", "boxes-sun", "terrain-sun"}) {
    const Scene scene = testing::data_scene(name);
    const SurfaceBuffer surface = make_surface_buffer(scene, RayScene(scene, 0), 160, 120);
    const Casters casters(scene.objects);
    for (const bool with_unoccluded : {false, true}) {
      const Difference off =
          from_hard(casters, scene.lights.front().shape, surface.receivers(), with_unoccluded);
      EXPECT_GT(off.shadowed, 100u) << name;
      expect_hard(off, name);
    }
  }
}

TEST(ShadowVolumes, AreTheHardShadowOfTrianglesThatAreNoSurface) {
  Random random(7);
  const Casters casters(std::vector<TriangleMesh>{testing::triangles_that_are_no_surface(random)});
  std::vector<Vec3> receivers;
  for (int i = 0; i < 20'000; ++i) receivers.push_back(random.point(2.5));
  const Difference off =
      from_hard(casters, DiskLight{{0.2, 3, -0.1}, {0.1, -1, 0}, 0.8}, {.points = receivers});
  EXPECT_GT(off.shadowed, 500u);
  expect_hard(off, "soup");
}

// Around the light, through its plane, behind it, far: receivers on all sides of everything.
TEST(ShadowVolumes, LightsInsideBehindAndFar) {
  const Casters casters(
      std::vector<TriangleMesh>{make_box(Vec3(0.0), {1, 1, 1}), make_icosphere({0.5, -2.0, 0.2}, 0.7, 2)});
  Random random(3);
  std::vector<Vec3> around;
  for (int i = 0; i < 10'000; ++i) around.push_back(random.point(4.0));
  const LightShape lights[] = {DiskLight{{0, 0.3, 0}, {0.2, -1, 0.1}, 0.4},    // inside of the box
                               DiskLight{{0.9, 0.2, 0.1}, {0.3, -1, 0}, 0.5},  // through a side
                               DiskLight{{0.1, -1, 0.1}, {0, -1, 0}, 0.5},     // on a face
                               DiskLight{{0, 1e7, 0}, {0.1, -1, 0}, 1e6},      // far
                               DiskLight{{2, 3, 1}, {0, -1, 0}, 0.0},          // a point
                               DiskLight{{-3, 0.2, 1}, {1, 0.1, 0}, 0.1},
                               DistantLight{{0.3, -1, 0.2}, 5.0},
                               DistantLight{{0, 0, 1}, 0.0}};
  for (const LightShape& light : lights)
    expect_hard(from_hard(casters, light, {.points = around}), name_of(light));
}

// Whoever stands in a volume, deep below or far above: where a volume ends does not show, nor which casters
// are left out.
TEST(ShadowVolumes, CullingAndClampingSaveWorkAndChangeNothing) {
  const Scene scene = testing::data_scene("boxes-medium");
  SurfaceBuffer surface = make_surface_buffer(scene, RayScene(scene, 0), 160, 120);
  std::vector<SceneObject> objects = scene.objects;
  objects.push_back({"aside", make_box({0, 1, 50}, {1, 1, 1}), Vec3(0.8), true});
  const Casters casters(objects);
  const LightShape& light = scene.lights.front().shape;
  const auto with = [&](const char* culling, const char* clamping) {
    return result(casters, light, surface.receivers(),
                  {{"volume-culling", std::string(culling)}, {"volume-clamping", std::string(clamping)}});
  };
  const MethodResult both = with("on", "on"), unculled = with("off", "on"), unclamped = with("on", "off");
  EXPECT_EQ(both.visibility, unculled.visibility);
  EXPECT_EQ(both.visibility, unclamped.visibility);
  const auto count = [](const MethodResult& of, const char* name) {
    return testing::count_in(of.counts, name);
  };
  EXPECT_GE(count(both, "culled_casters"), 1u);
  EXPECT_EQ(count(unculled, "culled_casters"), 0u);
  EXPECT_EQ(count(unculled, "casters"), count(both, "casters") + count(both, "culled_casters"));
  EXPECT_LE(count(both, "tested_polygons"), count(unclamped, "tested_polygons"));
  EXPECT_EQ(count(both, "crossed_polygons"), count(unclamped, "crossed_polygons"));
}

// A square and a light above its middle: five polygons, and the shadow is twice as wide on a floor twice as
// far away.
TEST(ShadowVolumes, OfASquareHaveACapOfTwoFacesAndFourSides) {
  const Casters casters(std::vector<TriangleMesh>{testing::rectangle(-1, 1, -1, 1, 1.0)});
  std::vector<Vec3> floor;
  for (double x = -2.95; x < 3.0; x += 0.1) floor.emplace_back(x, 0.35, 2.0);
  const MethodResult seen = result(casters, DiskLight{Vec3(0.0), {0, 0, 1}, 0.1}, {.points = floor});
  EXPECT_EQ(testing::count_in(seen.counts, "volume_caps"), 2u);
  EXPECT_EQ(testing::count_in(seen.counts, "volume_sides"), 4u);
  for (std::size_t i = 0; i < floor.size(); ++i)
    EXPECT_EQ(seen.visibility[i], std::abs(floor[i].x) < 2.0 ? 0.0f : 1.0f) << floor[i].x;
}

TEST(ShadowVolumes, EmptyScenesAndBadSettings) {
  const testing::MethodUnderTest seen("shadow-volumes");
  seen.expect_empty_scenes_are_lit();
  seen.expect_are_refused({"volume-culling", "volume-clamping"}, {std::uint64_t{1}, "maybe"});
}

}  // namespace
}  // namespace penumbra
