// The method layered-attenuation: the share of the light's points that see a receiver, within texels.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "render/light/light_projection.h"
#include "tests/render/method_support.h"

namespace penumbra {
namespace {

using testing::kUnitDisk;
using testing::Values;

/// A sheet in z = 1 with its edge at x = 0 over a floor in z = 2, and a row of pixels on the floor.
struct SheetOverFloor {
  SheetOverFloor() {
    std::vector<Vec3> points;
    for (int k = 0; k < 50; ++k) points.emplace_back(-1.22 + 0.05 * k, 0.31, 2.0);
    surface = testing::receivers(points, Vec3(0, 0, -1), 50);
  }
  Values seen(const LightShape& light, const OptionValues& options = {}) const {
    return visibility(Casters(objects), light, surface.receivers(),
                      {.method = "layered-attenuation", .options = options})
        .visibility;
  }
  std::vector<SceneObject> objects{{"floor", testing::rectangle(-4, 4, -4, 4, 2.0), Vec3(0.8), false},
                                   {"sheet", testing::rectangle(0, 5, -5, 5, 1.0), Vec3(0.8), true}};
  SurfaceBuffer surface;
};

TEST(LayeredAttenuation, IsTheShareOfTheLightBesideAnEdge) {
  const SheetOverFloor scene;
  const OptionValues fine{{"light-views", std::uint64_t{256}}, {"attenuation-size", std::uint64_t{128}}};
  const Values values = scene.seen(kUnitDisk, fine);
  for (std::size_t i = 0; i < values.size(); ++i)
    EXPECT_NEAR(values[i], half_plane_area(-scene.surface.position[i].x), 0.05)
        << scene.surface.position[i].x;
  const RectangleLight light{
      .center = Vec3(0.0), .normal = {0, 0, 1}, .tangent = {1, 0, 0}, .half_extents = {0.5, 1.5}};
  const Values of_rectangle = scene.seen(light, fine);
  for (std::size_t i = 0; i < values.size(); ++i)
    EXPECT_NEAR(of_rectangle[i], std::clamp(0.5 - scene.surface.position[i].x, 0.0, 1.0), 0.06)
        << scene.surface.position[i].x;
}

// What a point beside the center sees is the center's view, sheared; near and far.
TEST(LayeredAttenuation, PointsOfTheLightSeeTheCentersViewSheared) {
  testing::Random random(4);
  for (const LightShape& shape : {LightShape(DiskLight{{0.2, 3, 0.1}, {0.1, -1, 0.2}, 0.7}),
                                  LightShape(DistantLight{{0.2, -1, 0.1}, 20.0})}) {
    const AreaLight light = area_light(shape);
    const LightProjection center(light, {0.1, 0.2, 0.3}, 0.1);
    for (int i = 0; i < 200; ++i) {
      const glm::dvec2 d(random.uniform(-1, 1), random.uniform(-1, 1));
      const LightProjection other = center.seen_from(d);
      const Vec3 local = center.local(random.point(0.8));
      const double weight = center.weight(local), height = -local.z / weight;
      const glm::dvec2 expected = center.place(local) / weight - center.spread() * d * height;
      EXPECT_NEAR(glm::distance(other.place(local) / other.weight(local), expected), 0.0, 1e-12);
    }
  }
}

// More points and texels are closer to the truth, on a scene with slopes and self-shadows.
TEST(LayeredAttenuation, ComesCloserWithMorePointsAndTexels) {
  const Scene scene = testing::data_scene("boxes-medium");
  const SurfaceBuffer surface = make_surface_buffer(scene, RayScene(scene, 0), 80, 60);
  const Casters casters(scene.objects);
  const LightShape& light = scene.lights.front().shape;
  const Values truth = visibility(casters, light, surface.receivers()).visibility;
  const auto rmse = [&](std::uint64_t size, std::uint64_t views) {
    const Values ours = visibility(casters, light, surface.receivers(),
                                   {.method = "layered-attenuation",
                                    .options = {{"attenuation-size", size}, {"light-views", views}}})
                            .visibility;
    double sum = 0.0;
    std::size_t partly = 0;
    for (std::size_t i = 0; i < ours.size(); ++i) {
      if (!(truth[i] > 0.0f && truth[i] < 1.0f)) continue;
      sum += (ours[i] - truth[i]) * (ours[i] - truth[i]);
      ++partly;
    }
    return std::sqrt(sum / static_cast<double>(partly));
  };
  const double few = rmse(128, 16), many = rmse(512, 64);
  std::printf("RMSE %.4f with 16 views and 128 texels, %.4f with 64 and 512\n", few, many);
  EXPECT_LT(many, few);
  EXPECT_LT(many, 0.2);
}

TEST(LayeredAttenuation, EmptyScenesBadSettingsAndLightsAnywhere) {
  SheetOverFloor scene;
  const Values lit(50, 1.0f), dark(50, 0.0f);
  const OptionValues small{{"attenuation-size", std::uint64_t{64}}, {"light-views", std::uint64_t{16}}};
  EXPECT_EQ(scene.seen(DiskLight{{0, 0, 3}, {0, 0, 1}, 1.0}, small), dark) << "behind the light";
  for (const LightShape& light :
       {LightShape(DiskLight{{0.5, 0, 1}, {0, 0, 1}, 0.4}),
        LightShape(DiskLight{{0, 0, -1e9}, {0, 0, 1}, 1e8}),
        LightShape(DiskLight{Vec3(0.0), {0, 0, 1}, 30.0}), LightShape(DistantLight{{0.3, 0.2, 1}, 120.0})})
    for (const float v : scene.seen(light, small)) EXPECT_TRUE(v >= 0.0f && v <= 1.0f) << v;
  scene.objects.pop_back();
  EXPECT_EQ(scene.seen(kUnitDisk, small), lit) << "nothing casts";
  for (const OptionValue& bad : {OptionValue(-1.0), OptionValue(std::uint64_t{100'000}), OptionValue("many")})
    for (const char* option : {"attenuation-size", "light-views", "layer-tolerance"})
      EXPECT_THROW(scene.seen(kUnitDisk, {{option, bad}}), UsageError);
  const std::vector<Vec3> points{{0, 0, 2}};
  EXPECT_THROW(
      visibility(Casters(scene.objects), kUnitDisk, {.points = points}, {.method = "layered-attenuation"}),
      UsageError)
      << "points on no surface";
}

}  // namespace
}  // namespace penumbra
