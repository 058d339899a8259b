#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "penumbra/mesh/shapes.h"
#include "penumbra/render/renderer.h"
#include "render/rays/glass/glass_rays.h"

namespace penumbra {
namespace {

constexpr int kSide = 33;  // odd, so that the middle pixel's ray is the camera's axis
constexpr std::size_t kMiddle = kSide * (kSide / 2) + kSide / 2;

/// A cube at the origin, seen along -z, before a wall at z = -4; a light above the camera.
Scene scene_with(std::vector<GlassBody> glass) {
  Scene scene;
  scene.lights.push_back({.shape = DiskLight{.center = {0, 6, 10}, .normal = {0, -0.5, -1}, .radius = 0.3}});
  scene.camera = {.eye = {0, 0, 10}, .target = {0, 0, 0}, .fov_y_degrees = 20};
  scene.objects.push_back({.name = "cube", .mesh = make_box({-3, 0, 0}, {0.5, 0.5, 0.5})});
  scene.objects.push_back({.name = "wall", .mesh = make_box({0, 0, -5}, {9, 9, 1}), .casts = false});
  scene.glass = std::move(glass);
  return scene;
}

Image picture_of(const Scene& scene, int antialias = 1) {
  return render(scene, {.width = kSide, .height = kSide, .antialias = antialias}).image;
}

float red_of(const Scene& scene) {
  return picture_of(scene).at("R")[kMiddle];
}

/// Black, so that what is left is what the glass lets through.
GlassBody black(const Vec3& center, double half, double density) {
  return {.mesh = make_box(center, Vec3(half)), .tint = Vec3(0.0), .density = density};
}

double diagonal_of(const Scene& scene) {
  return 2.0 * scene.caster_bounds().radius();
}

TEST(Glass, HidesByTheWayThroughIt) {
  const Scene bare = scene_with({});
  for (const double half : {0.2, 0.5, 1.0}) {
    const double left = std::pow(1.0 - 0.6, 2.0 * half / diagonal_of(bare));
    EXPECT_NEAR(red_of(scene_with({black(Vec3(0.0), half, 0.6)})), left * red_of(bare), 1e-4) << half;
  }
}

TEST(Glass, WhereNothingCastsIsAsThickAsTheScene) {
  Scene bare = scene_with({});
  bare.objects.erase(bare.objects.begin());
  Scene scene = bare;
  scene.glass = {black(Vec3(0.0), 0.5, 0.6)};
  const double left = std::pow(0.4, 1.0 / (2.0 * scene.bounds().radius()));
  EXPECT_NEAR(red_of(scene), left * red_of(bare), 1e-4);
}

TEST(Glass, EndsAtSurfacesAndHoldsTheEye) {
  const Scene bare = scene_with({});
  // Half in the wall, in the wall, around the eye.
  const auto expected = [&](double way) {
    return std::pow(0.4, way / diagonal_of(bare)) * static_cast<double>(red_of(bare));
  };
  EXPECT_NEAR(red_of(scene_with({black({0, 0, -4}, 0.5, 0.6)})), expected(0.5), 1e-4);
  EXPECT_EQ(red_of(scene_with({black({0, 0, -5}, 0.5, 0.6)})), red_of(bare));
  EXPECT_NEAR(red_of(scene_with({black({0, 0, 10}, 1.0, 0.6)})), expected(1.0), 1e-4);
}

TEST(Glass, TheLastOfThoseThatOverlapCounts) {
  const Scene bare = scene_with({});
  const double d = diagonal_of(bare);
  const double left = std::pow(0.5, 2.0 / d) * std::pow(0.1, 1.0 / d);
  const Scene nested = scene_with({black(Vec3(0.0), 1.5, 0.5), black(Vec3(0.0), 0.5, 0.9)});
  EXPECT_NEAR(red_of(nested), left * static_cast<double>(red_of(bare)), 1e-4);
}

TEST(Glass, ShowsItsTintAndChangesNothingElse) {
  const Scene bare = scene_with({});
  const Scene glass =
      scene_with({{.mesh = make_box(Vec3(0.0), Vec3(0.5)), .tint = {1, 0, 0}, .density = 1.0}});
  const Image with = picture_of(glass), without = picture_of(bare);
  EXPECT_GT(with.at("R")[kMiddle], 0.0f);
  EXPECT_EQ(with.at("G")[kMiddle], 0.0f);
  for (const auto& [name, values] : without.channels)
    if (name != "R" && name != "G" && name != "B" && name != "A") {
      EXPECT_EQ(with.at(name), values) << name;
    }
  // Opaque before nothing, too, and smooth at its border with more samples a pixel.
  Scene alone = glass;
  alone.objects.pop_back();
  EXPECT_EQ(picture_of(alone).at("A")[kMiddle], 1.0f);
  EXPECT_EQ(picture_of(alone).at("A")[0], 0.0f);
  const std::vector<float> smooth = picture_of(alone, 3).at("A");
  EXPECT_TRUE(std::ranges::any_of(smooth, [](float a) { return a > 0.1f && a < 0.9f; }));
}

TEST(Glass, LightsAreSeenFromTheFrontAndBlackFromBehind) {
  Scene scene = scene_with({});
  scene.lights[0] = {.shape = DiskLight{.center = {0, 0, 2}, .normal = {0, 0, 1}, .radius = 0.5},
                     .radiance = Vec3(7.0)};
  EXPECT_NE(red_of(scene), 7.0f);
  scene.picture.show_lights = true;
  EXPECT_EQ(red_of(scene), 7.0f);
  EXPECT_NE(picture_of(scene).at("R")[0], 7.0f);
  scene.lights[0].shape = DiskLight{.center = {0, 0, 2}, .normal = {0, 0, -1}, .radius = 0.5};
  EXPECT_EQ(red_of(scene), 0.0f);
  scene.lights[0].shape =
      DiskLight{.center = {0, 0, -6.5}, .normal = {0, 0, 1}, .radius = 0.5};  // behind the wall
  EXPECT_NE(red_of(scene), 7.0f);
  scene.lights[0].shape = RectangleLight{
      .center = {0, 0, 2}, .normal = {0, 0, 1}, .tangent = {1, 0, 0}, .half_extents = {2.0, 0.1}};
  const std::vector<float> red =
      render(scene, {.method = "hard", .width = kSide, .height = kSide}).image.at("R");
  EXPECT_EQ(red[kMiddle], 7.0f);
  EXPECT_EQ(red[kMiddle + 10], 7.0f);
  EXPECT_NE(red[kMiddle + 10 * kSide], 7.0f);
}

// A ray through a vertex may miss a crossing: then no way through the body would be seen, or one without end.
TEST(Glass, RaysThroughVerticesSeeTheWholeBody) {
  const Vec3 center(0.3, -0.2, 0.0);
  const TriangleMesh ball = make_icosphere(center, 1.0, 3);
  Scene scene = scene_with({{.mesh = ball, .tint = Vec3(0.0), .density = 0.9}});
  scene.camera.eye = center + 3.0 * glm::normalize(Vec3(1.0, 2.0, 3.0));
  scene.picture.ambient = Vec3(1.0);
  scene.objects[1].mesh = make_box({0, 0, -5}, {60, 60, 1});
  int looked_at = 0;
  for (std::size_t v = 0; v < ball.positions().size(); ++v) {
    const Vec3 way = glm::normalize(ball.positions()[v] - scene.camera.eye);
    const double beside = glm::length(glm::cross(center - scene.camera.eye, way));
    if (beside > 0.95) continue;
    scene.camera.target = ball.positions()[v];
    Scene bare = scene;
    bare.glass.clear();
    const double before = render(scene, {.width = 1, .height = 1}).image.at("R")[0];
    const double without = render(bare, {.width = 1, .height = 1}).image.at("R")[0];
    ASSERT_GT(without, 0.0);
    const double chord = 2.0 * std::sqrt(1.0 - beside * beside);
    EXPECT_NEAR(std::log(before / without) / std::log(0.1) * diagonal_of(scene), chord, 0.25)
        << v << ": the surface itself hides what 0.15 of a way would at most";
    ++looked_at;
  }
  EXPECT_GT(looked_at, 300);
}

TEST(GlassRays, CrossAClosedSurfaceInAndOutOnceEach) {
  // Far from the origin of the world, and from far away.
  for (const double far : {3.0, 1e4}) {
    const Vec3 center(100.0, -50.0, 20.0);
    const TriangleMesh ball = make_icosphere(center, 1.0, 3);
    const GlassRays rays(std::vector<GlassBody>{{.mesh = ball}});
    std::vector<GlassCrossing> crossings;
    std::mt19937 random(7);
    std::normal_distribution<double> normal;
    const Vec3 eye = center + far * glm::normalize(Vec3(1.0, 2.0, 3.0));
    for (int i = 0; i < 3000; ++i) {
      // Through the middles of edges, too.
      const IndexedTriangle& t = ball.triangles()[static_cast<std::size_t>(i) % ball.triangles().size()];
      const Vec3 target = i % 2 == 0 ? 0.5 * (ball.positions()[t[0]] + ball.positions()[t[1]])
                                     : center + 0.3 * Vec3(normal(random), normal(random), normal(random));
      rays.find_crossings(eye, target - eye, crossings);
      // Rays along the outline are in or out as float has it.
      const double beside = glm::length(glm::cross(center - eye, glm::normalize(target - eye)));
      if (beside > 0.95) continue;
      ASSERT_EQ(crossings.size(), 2u) << "seed 7, ray " << i << ", beside " << beside;
      EXPECT_TRUE(crossings[0].enters && !crossings[1].enters);
      const double half_chord = std::sqrt(1.0 - beside * beside), scale = glm::length(target - eye);
      EXPECT_NEAR((crossings[1].distance - crossings[0].distance) * scale, 2.0 * half_chord, 0.05);
    }
  }
}

}  // namespace
}  // namespace penumbra
