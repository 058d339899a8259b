// The method auto: what it leaves out changes nothing.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "penumbra/render/visibility.h"
#include "render/plan/auto_method.h"
#include "render/plan/cost_model.h"
#include "tests/render/render_support.h"

namespace penumbra {
namespace {

using testing::Random;

/// Boxes, balls and loose triangles strewn over a floor of which the camera sees a part.
Scene strewn(std::uint64_t seed, std::size_t casters) {
  Random random(seed);
  Scene scene;
  scene.objects.push_back({.name = "floor", .mesh = make_plane(20.0), .casts = random.uniform(0, 1) < 0.5});
  for (std::size_t i = 0; i < casters; ++i) {
    const Vec3 middle{random.uniform(-10, 10), random.uniform(0.2, 2.0), random.uniform(-10, 10)};
    const double size = random.spread(0.05, 0.8), kind = random.uniform(0, 3);
    TriangleMesh mesh = kind < 1.0   ? make_box(middle, Vec3(size))
                        : kind < 2.0 ? make_icosphere(middle, size, 1)
                                     : make_random_triangles(middle, size, 0.5 * size, 8, seed + i);
    scene.objects.push_back({.name = "caster", .mesh = std::move(mesh)});
  }
  const Vec3 target{random.uniform(-6, 6), 0.3, random.uniform(-6, 6)};
  scene.camera = {.eye = target + Vec3(1.5, 2.0, 2.5), .target = target, .fov_y_degrees = 40.0};
  const Vec3 normal = Vec3(0, -1, 0) + 0.6 * random.point();
  if (random.uniform(0, 1) < 0.3)
    scene.lights.push_back({.shape = DistantLight{normal, random.spread(0.1, 20.0)}});
  else
    scene.lights.push_back(
        {.shape = DiskLight{{random.uniform(-6, 6), random.uniform(1.0, 8.0), random.uniform(-6, 6)},
                            normal,
                            random.spread(0.01, 2.0)}});
  return scene;
}

struct Pictures {
  MethodResult planned, whole;
  LightPlan plan;
};

/// By auto, and by the method that it chose among all casters. `by_areas`: areas at all receivers are asked
/// for.
Pictures see_both(const Scene& scene, const Receivers& receivers, bool by_areas = false) {
  const RayScene rays(scene, 0);
  const LightShape& light = scene.lights.front().shape;
  Pictures out;
  out.plan = plan_light(scene, rays, light, receivers,
                        {.effects = {.areas = by_areas ? EffectChoice::kOn : EffectChoice::kPlanned}});
  const Casters casters(scene.objects);
  out.planned = visibility(casters, light, receivers,
                           {.method = "auto", .options = {{"effect-areas", by_areas ? "on" : "planned"}}});
  const bool runs = out.plan.action == LightPlan::Action::kMethod;
  out.whole = visibility(casters, light, receivers,
                         {.method = runs ? out.plan.method : "silhouette", .options = out.plan.options});
  return out;
}

TEST(AutoMethod, WhatItLeavesOutChangesNothing) {
  std::size_t left_out = 0, unshadowed = 0, dark = 0, by_silhouettes = 0, by_rays = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const Scene scene = strewn(seed, seed % 3 == 0 ? 3 : 40);
    const testing::View view(scene, 96, 72);
    const Receivers receivers = view.surface.receivers();
    const Pictures both = see_both(scene, receivers, seed % 2 == 0);
    left_out += both.plan.left_out.size();
    unshadowed += both.plan.action == LightPlan::Action::kUnshadowed ? 1 : 0;
    dark += both.plan.action == LightPlan::Action::kDark ? 1 : 0;
    by_silhouettes += both.plan.method == "silhouette" ? 1 : 0;
    by_rays += both.plan.method == "rays" ? 1 : 0;
    for (std::size_t i = 0; i < receivers.size(); ++i) {
      ASSERT_NEAR(both.planned.visibility[i], both.whole.visibility[i], 2e-5) << "seed " << seed << ", " << i;
      // A certificate may be had or not by rounding; it is never another one.
      if (both.planned.region[i] >= 0 && !both.whole.region.empty() && both.whole.region[i] >= 0) {
        ASSERT_EQ(both.planned.region[i], both.whole.region[i]) << "seed " << seed << ", " << i;
      }
    }
  }
  EXPECT_GT(left_out, 300u);
  EXPECT_GT(unshadowed, 0u);
  EXPECT_GT(by_silhouettes, 20u);
  EXPECT_GT(by_rays, 5u);
}

// A thin post whose penumbra's edge is moved over the one visible receiver, by steps of a thousandth of the
// light.
TEST(AutoMethod, ACasterThatOnlyJustReachesIsKept) {
  const DiskLight light{{0, 4, 0}, {0, -1, 0}, 1.0};
  const std::vector<Vec3> points{{0, 0, 0}};
  std::size_t kept = 0, dropped = 0;
  for (int step = -60; step <= 60; ++step) {
    // The rim's shadow of the box's near side at height 2 touches the origin at x = ½.
    const double at = 0.5 + 1e-3 * step;
    Scene scene;
    scene.lights.push_back({.shape = light});
    scene.objects.push_back({.mesh = make_box({at + 0.1, 2.0, 0.0}, {0.1, 1e-9, 0.1})});
    const Pictures both = see_both(scene, {.points = points});
    const bool reaches = at < 0.5;
    kept += reaches ? 1 : 0;
    dropped += both.plan.action == LightPlan::Action::kUnshadowed ? 1 : 0;
    if (reaches) {
      EXPECT_EQ(both.plan.action, LightPlan::Action::kMethod) << step;
      EXPECT_LT(visibility(Casters(scene.objects), light, {.points = points}).visibility[0], 1.0f) << step;
    }
    EXPECT_EQ(both.planned.visibility, both.whole.visibility) << step;
  }
  EXPECT_EQ(kept, 60u);
  EXPECT_GT(dropped, 40u);
}

/// RMSE over the pixels that `truth` has in penumbra, and how many they are.
std::pair<double, std::size_t> error_in_penumbra(const std::vector<float>& values,
                                                 const std::vector<float>& truth) {
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (!(truth[i] > 0.0f && truth[i] < 1.0f)) continue;
    sum += (values[i] - truth[i]) * (values[i] - truth[i]);
    ++count;
  }
  return {std::sqrt(sum / static_cast<double>(std::max<std::size_t>(count, 1))), count};
}

// As many rays as the plan would take, whether or not it takes them. The judge is the silhouette method,
// whose own error is some hundredth of these.
TEST(AutoMethod, TakesRaysEnoughForTheErrorInNineteenOfTwenty) {
  std::size_t judged = 0, kept = 0, far_below = 0;
  for (std::uint64_t seed = 100; seed < 160; ++seed) {
    Scene scene = strewn(seed, 20);
    if (seed % 2 == 0)
      scene.objects.push_back(
          {.name = "leaves", .mesh = make_random_triangles(scene.camera.target, 1.2, 0.3, 300, seed)});
    const testing::View view(scene, 96, 72);
    const Receivers receivers = view.surface.receivers();
    const LightShape& light = scene.lights.front().shape;
    const LightPlan plan = plan_light(scene, view.rays, light, receivers, {});
    const Casters casters(scene.objects);
    const std::vector<float> truth = visibility(casters, light, receivers, {}).visibility;
    for (const double error : {0.08, 0.03}) {
      const auto samples = static_cast<std::uint64_t>(detail::rays_for(plan.facts, error));
      const MethodResult result =
          visibility(casters, light, receivers,
                     {.method = "reference", .options = {{"samples", samples}, {"seed", std::uint64_t{77}}}});
      const auto [rmse, pixels] = error_in_penumbra(result.visibility, truth);
      if (pixels < 100) continue;
      ++judged;
      kept += rmse <= error ? 1 : 0;
      far_below += rmse <= 0.3 * error ? 1 : 0;
    }
  }
  EXPECT_GT(judged, 60u);
  EXPECT_GE(20 * kept, 19 * judged) << kept << " of " << judged;
  // Nor many more rays than are needed; but of so small a picture few receivers lie in penumbra, and the
  // margin is large.
  EXPECT_LE(5 * far_below, judged) << far_below << " of " << judged;
}

// Pixels at which the hard shadow is wrong lie beside its boundary, where the penumbra is said to be narrower
// than a pixel.
TEST(AutoMethod, ANarrowPenumbraLiesBesideTheHardShadow) {
  std::size_t hard = 0, wrong = 0;
  for (const double radius : {0.0005, 0.002, 0.1}) {
    Scene scene = testing::data_scene("boxes-small");
    scene.objects[1].mesh = make_box({0.2, 5.0, 0.1}, {0.8, 0.02, 0.6});
    testing::light_of(scene).radius = radius;
    const testing::View view(scene, 160, 120);
    const Receivers receivers = view.surface.receivers();
    const LightPlan plan =
        plan_light(scene, view.rays, scene.lights.front().shape, receivers, {.hard_below = 0.5});
    if (plan.method != "hard") continue;
    ++hard;
    const Casters casters(scene.objects);
    const auto by = [&](const char* method) {
      return visibility(casters, scene.lights.front().shape, receivers, {.method = method}).visibility;
    };
    const std::vector<float> sharp = by("hard"), soft = by("silhouette");
    for (std::size_t i = 0; i < soft.size(); ++i) {
      if (std::abs(soft[i] - sharp[i]) < 1e-3f) continue;
      ++wrong;
      const std::size_t w = 160, x = i % w, y = i / w;
      bool beside = false;
      for (std::size_t v = y - std::min<std::size_t>(y, 1); v <= std::min<std::size_t>(y + 1, 119); ++v)
        for (std::size_t u = x - std::min<std::size_t>(x, 1); u <= std::min<std::size_t>(x + 1, w - 1); ++u)
          beside = beside || sharp[v * w + u] != sharp[i];
      EXPECT_TRUE(beside) << "radius " << radius << ", pixel " << x << ", " << y;
    }
  }
  EXPECT_EQ(hard, 2u) << "the widest light has a penumbra of many pixels";
  EXPECT_GT(wrong, 0u);
}

// Of four hundred casters those in view and those whose shadow is are looked at, and no others.
TEST(AutoMethod, LooksAtTheEdgesOfCastersThatReachAlone) {
  Scene scene;
  scene.objects.push_back({.name = "floor", .mesh = make_plane(100.0), .casts = false});
  for (int i = 0; i < 400; ++i)
    scene.objects.push_back(
        {.name = "ball",
         .mesh = make_icosphere({8.0 * (i % 20) - 76.0, 1.0, 8.0 * (i / 20) - 76.0}, 0.8, 1)});
  scene.camera = {.eye = {-74, 6, -72}, .target = {-78, 0, -78}, .fov_y_degrees = 40.0};
  scene.lights.push_back({.shape = DiskLight{{-70, 12, -70}, {0, -1, 0}, 0.5}});
  const testing::View view(scene, 96, 72);
  const Casters casters(scene.objects);
  const auto by = [&](const char* method) {
    return visibility(casters, scene.lights.front().shape, view.surface.receivers(), {.method = method});
  };
  const MethodResult planned = by("auto"), whole = by("silhouette");
  const auto edges = [](const MethodResult& result) {
    return testing::count_in(result.counts, "mesh_edges");
  };
  EXPECT_EQ(edges(whole), 400u * 120u);
  EXPECT_LE(edges(planned), 10u * 120u);
  EXPECT_GT(edges(planned), 0u);
  for (std::size_t i = 0; i < whole.visibility.size(); ++i)
    ASSERT_NEAR(planned.visibility[i], whole.visibility[i], 2e-5) << i;
}

TEST(AutoMethod, RunsNothingWhereNoCasterReaches) {
  Scene scene = testing::data_scene("cube-medium");
  testing::light_of(scene) = {{0, -3, 0}, {0, -1, 0}, 0.5};
  const testing::View below(scene, 64, 48);
  const MethodResult dark = visibility(Casters(scene.objects), scene.lights.front().shape,
                                       below.surface.receivers(), {.method = "auto"});
  EXPECT_TRUE(dark.counts.empty()) << "no method ran";
  EXPECT_TRUE(dark.setup.empty());
  EXPECT_TRUE(std::ranges::all_of(dark.decisions, [](const Decision& d) { return d.is_certificate; }));
}

TEST(AutoMethod, GivesTheUnoccludedFraction) {
  const Scene scene = testing::data_scene("torus-medium");
  const testing::View view(scene, 64, 48);
  const Casters casters(scene.objects);
  const LightShape& light = scene.lights.front().shape;
  const auto by = [&](const char* method) {
    return visibility(casters, light, view.surface.receivers(), {.method = method, .with_unoccluded = true});
  };
  EXPECT_EQ(by("auto").unoccluded, by("silhouette").unoccluded);
}

TEST(AutoMethod, TakesRectanglesByRays) {
  Scene scene = testing::data_scene("cube-medium");
  const LightShape light = RectangleLight{.center = {0, 4, 0}};
  const testing::View view(scene, 64, 48);
  const MethodResult result =
      visibility(Casters(scene.objects), light, view.surface.receivers(), {.method = "auto"});
  EXPECT_EQ(result.decisions.back().choice, "reference");
}

}  // namespace
}  // namespace penumbra
