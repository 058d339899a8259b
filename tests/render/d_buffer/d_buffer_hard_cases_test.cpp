// Lights and casters that are missing, touch each other, cross a plane or need several targets.
#include <gtest/gtest.h>

#include <cmath>

#include "render/d_buffer/view/targets.h"
#include "render/light/light_integrals.h"
#include "tests/render/d_buffer/d_buffer_support.h"

namespace penumbra {
namespace {

using testing::all_in_range;
using testing::at_pixels;
using testing::draw_d_buffer;
using testing::error_over_penumbra;
using testing::Pixels;
using testing::Random;
using testing::Values;
using testing::View;

/// Receivers all over the space in front of the light and a little behind, turned at random.
SurfaceBuffer scattered_receivers(std::uint64_t seed, const DiskLight& light, int count) {
  Random random(seed);
  std::vector<Vec3> points, normals;
  for (int i = 0; i < count; ++i) {
    points.push_back(light.center + random.point(5.0) + 4.0 * glm::normalize(light.normal));
    normals.push_back(random.direction());
  }
  return testing::receivers(points, normals, 64);
}

TEST(DBuffer, WithoutCastersIsTheHorizonsFraction) {
  Scene scene;
  testing::light_of(scene) = {{0.3, 5, 0.2}, {0.2, -1, 0.1}, 0.7};
  scene.objects.push_back({"floor", make_plane(6.0), Vec3(0.8), false});
  constexpr std::uint64_t kSeed = 99;
  const SurfaceBuffer surface = scattered_receivers(kSeed, testing::light_of(scene), 4'096);
  const Values v = draw_d_buffer(scene, surface, {.size = 64}).visibility;
  for (std::size_t i = 0; i < v.size(); ++i)
    ASSERT_NEAR(
        v[i], fraction_above_horizon(testing::light_of(scene), surface.position[i], surface.normal[i]), 1e-5)
        << "seed " << kSeed << ", receiver " << i;
}

TEST(DBuffer, OfAnEmptyMeshListAndNoObjects) {
  Scene scene;
  testing::light_of(scene) = {{0, 5, 0}, {0, -1, 0}, 0.5};
  const SurfaceBuffer surface = testing::receivers(std::vector<Vec3>(64, Vec3(0.0)), Vec3(0, 1, 0), 64);
  for (const float v : draw_d_buffer(scene, surface, {.size = 64}).visibility) ASSERT_NEAR(v, 1.0f, 1e-6f);
  scene.objects.push_back({"nothing", TriangleMesh(), Vec3(0.8), true});
  for (const float v : draw_d_buffer(scene, surface, {.size = 64}).visibility) ASSERT_NEAR(v, 1.0f, 1e-6f);
}

TEST(DBuffer, CasterBehindTheLightCastsNothing) {
  Scene scene;
  testing::light_of(scene) = {{0, 5, 0}, {0, -1, 0}, 0.5};
  scene.objects.push_back({"floor", make_plane(6.0), Vec3(0.8), false});
  scene.objects.push_back({"box", make_box({0, 7, 0}, Vec3(1.0)), Vec3(0.8), true});
  const SurfaceBuffer surface = scattered_receivers(5, testing::light_of(scene), 4'096);
  const Values v = draw_d_buffer(scene, surface, {.size = 128}).visibility;
  for (std::size_t i = 0; i < v.size(); ++i)
    ASSERT_NEAR(
        v[i], fraction_above_horizon(testing::light_of(scene), surface.position[i], surface.normal[i]), 1e-5)
        << i;
}

TEST(DBuffer, SurvivesLightsInsideOrTouchingCasters) {
  const Vec3 centers[] = {{0, 0, 0},        {0, 1, 0}, {1, 1, 1},          {1, 1, 0},   {0, 0.999999, 0},
                          {0, 1.000001, 0}, {0, 2, 0}, {0.5, 1 + 1e-9, 0}, {1.5, 0, 0}, {0, -1, 0}};
  for (const Vec3& center : centers) {
    Scene scene;
    testing::light_of(scene) = {center, {0, -1, 0}, 5.0};
    scene.objects.push_back({"floor", make_plane(6.0), Vec3(0.8), false});
    scene.objects.push_back({"box", make_box(Vec3(0.0), Vec3(1.0)), Vec3(0.8), true});
    const RayScene rays(scene, 0);
    DBuffer buffer(testing::d_buffer_context(), scene, rays);
    for (const Vec3& normal : {Vec3(0, -1, 0), Vec3(0, 1, 0), Vec3(1, 1, 1)}) {
      testing::light_of(scene).normal = normal;
      buffer.set_surface(scattered_receivers(6, testing::light_of(scene), 1'024).receivers());
      for (const double radius : {1e-6, 0.3, 5.0}) {
        testing::light_of(scene).radius = radius;
        ASSERT_TRUE(all_in_range(buffer.render(testing::light_of(scene), {.size = 64}).visibility))
            << "light at " << center.x << " " << center.y << " " << center.z << ", radius " << radius;
      }
    }
  }
}

// A box through the light's plane, beside the disk: its shadow lies where the rays say.
TEST(DBuffer, CasterAcrossTheLightsPlane) {
  Scene scene;
  testing::light_of(scene) = {{0, 5, 0}, {0, -1, 0}, 0.5};
  scene.camera = {{0, 9, 12}, {0, 0, 0}, {0, 1, 0}, 50};
  scene.objects.push_back({"floor", make_plane(8.0), Vec3(0.8), false});
  scene.objects.push_back({"box", make_box({2, 4.5, 0}, {0.4, 1.5, 0.6}), Vec3(0.8), true});
  const View view(scene, 160, 120);
  const DBufferFrame frame = draw_d_buffer(scene, view.surface, {.size = 512});
  EXPECT_TRUE(all_in_range(frame.visibility));
  const Pixels floor = testing::pixels_of(view.surface, 0);
  const Values r1 = view.trace(floor, 64, 21), r2 = view.trace(floor, 64, 22),
               v = at_pixels(frame.visibility, floor);
  const ErrorFigures figures = testing::penumbra_error(v, r1, r2);
  std::printf("across the light's plane: %zu pixels, RMSE %.4f\n", figures.pixels, figures.rmse);
  EXPECT_GT(figures.pixels, 200u);
  EXPECT_LE(figures.rmse, 0.01) << "corners, and texels of a coarse hemicube";
  std::size_t umbra = 0, dark = 0;
  for (std::size_t i = 0; i < floor.size(); ++i) {
    if (r1[i] + r2[i] > 0.0f) continue;
    ++umbra;
    dark += v[i] < 0.05f;
  }
  EXPECT_GT(umbra, 100u);
  EXPECT_GT(static_cast<double>(dark), 0.98 * static_cast<double>(umbra));
}

/// A box at |x/z| up to `widest` and one below the light, over a floor in the light's frame.
Scene box_at_tangent(double widest) {
  Scene scene = testing::scene_in_light_frame(0.4, {});
  const double nearest = 4.0, far = 10.0;
  // The window reaches to the box's outer corner plus the penumbra's width there.
  const double reach = 0.4 * (1.0 / nearest - 1.0 / far);
  const double outer = (widest - reach) * nearest;
  scene.camera = {{0.3 * outer, 0, -4}, {outer, 0, far}, {0, 1, 0}, 75};
  scene.objects.push_back({"floor", testing::rectangle(-60, 60, -60, 60, far), Vec3(0.8), false});
  scene.objects.push_back({"box", make_box({outer - 0.7, 0, 4.5}, {0.7, 0.6, 0.5}), Vec3(0.8), true});
  scene.objects.push_back({"middle", make_box({0, 0, 4.5}, {0.3, 0.3, 0.5}), Vec3(0.8), true});
  return scene;
}

// The same shadow by one perspective and by a hemicube, either side of where the engine changes over.
TEST(DBuffer, WideScenesUseAHemicubeThatAgreesWithOnePerspective) {
  double rmse[2];
  for (const bool wide : {false, true}) {
    const Scene scene = box_at_tangent(detail::kWidestWindow * (wide ? 1.02 : 0.95));
    const View view(scene, 240, 180);
    const DBufferFrame frame = draw_d_buffer(scene, view.surface, {.size = 1024});
    EXPECT_EQ(testing::count_in(frame.counts, "targets"), wide ? 2u : 1u)
        << "the front, and the side that the box is on";
    EXPECT_TRUE(all_in_range(frame.visibility));
    const ErrorFigures figures =
        error_over_penumbra(view, frame.visibility, testing::pixels_of(view.surface, 0));
    std::printf("%s: %zu pixels, RMSE %.4f\n", wide ? "hemicube" : "one target", figures.pixels,
                figures.rmse);
    EXPECT_GT(figures.pixels, 300u);
    rmse[wide] = figures.rmse;
  }
  // A box is exact but for corners whose texels are taken by the wrong edge.
  EXPECT_LE(rmse[0], 0.01);
  EXPECT_LE(rmse[1], 0.01);
}

// A post that ends just below the lamp hides the center from everywhere, and all entries are wrong alike:
// nothing contradicts anything, so that only rays at even distances tell.
TEST(DBuffer, APostBelowTheLampDoesNotDarkenTheFloor) {
  const Scene scene = testing::scene_in_light_frame(0.5, {make_box({0, 0, 2.01}, {0.04, 0.04, 1.99})});
  std::vector<Vec3> points;
  for (int j = 0; j < 120; ++j)
    for (int i = 0; i < 160; ++i) points.push_back({0.05 * i - 4.013, 0.05 * j - 3.017, 4.0});
  const SurfaceBuffer surface = testing::receivers(points, Vec3(0, 0, -1), 160);
  const RayScene rays(scene, 0);
  const Values truth = testing::see_silhouettes(scene, rays, surface).visibility;
  const Values v = draw_d_buffer(scene, surface).visibility;
  double squares = 0.0;
  for (std::size_t i = 0; i < v.size(); ++i) squares += (v[i] - truth[i]) * (v[i] - truth[i]);
  const double rmse = std::sqrt(squares / static_cast<double>(v.size()));
  std::printf("a post below the lamp: RMSE %.4f\n", rmse);
  EXPECT_LE(rmse, 0.03);
}

}  // namespace
}  // namespace penumbra
