// Effects that a plan is told to do or to leave out: counters prove that what is off executes nothing.
#include "penumbra/render/plan/effects.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "penumbra/mesh/error.h"
#include "penumbra/render/visibility.h"
#include "render/plan/auto_method.h"
#include "tests/render/render_support.h"

namespace penumbra {
namespace {

/// A ball of 5,120 faces, which may be merged, and leaves over a floor. Behind the camera stands a box whose
/// shadow nobody sees.
Scene ball_and_leaves() {
  Scene scene;
  scene.camera = {.eye = {3, 3.5, 5}, .target = {0, 0.4, 0}, .fov_y_degrees = 40.0};
  scene.lights.push_back({.shape = DiskLight{{0, 4, 0}, {0, -1, 0}, 0.5}});
  scene.objects.push_back({.name = "ball", .mesh = make_icosphere({-0.8, 0.8, 0}, 0.5, 4)});
  scene.objects.push_back(
      {.name = "leaves", .mesh = make_random_triangles({0.7, 0.8, 0}, 0.5, 0.15, 300, 1)});
  scene.objects.push_back({.name = "box", .mesh = make_box({0, 0.5, 40}, Vec3(0.5))});
  scene.objects.push_back({.name = "floor", .mesh = make_plane(6.0), .casts = false});
  return scene;
}

class EffectsTest : public ::testing::Test {
 protected:
  MethodResult see(const OptionValues& options) { return see(casters_, options); }
  MethodResult see(const Casters& casters, const OptionValues& options) {
    return visibility(casters, scene_.lights.front().shape, view_.surface.receivers(),
                      {.method = "auto", .options = options});
  }
  static std::uint64_t count(const MethodResult& result, const char* name) {
    const Count* found = find(result.counts, name);
    return found ? std::get<std::uint64_t>(found->value) : 0;
  }
  std::uint64_t receivers() const {
    return static_cast<std::uint64_t>(
        std::ranges::count_if(view_.surface.object, [](std::int32_t object) { return object >= 0; }));
  }

  Scene scene_ = ball_and_leaves();
  Casters casters_{scene_.objects};
  testing::View view_{scene_, 96, 72};
};

TEST_F(EffectsTest, WithoutShadowsNoRayIsTracedAndNothingIsMade) {
  const MethodResult off = see({{"effect-shadows", "off"}});
  EXPECT_TRUE(off.counts.empty());
  EXPECT_TRUE(off.setup.empty());
  EXPECT_EQ(off.decisions.back().reason, "told");
  EXPECT_GT(count(see({}), "rays"), 0u) << "else nothing is shown";
}

TEST_F(EffectsTest, WithoutPenumbraARayAReceiverIsAll) {
  const MethodResult off = see({{"effect-penumbra", "off"}});
  EXPECT_EQ(off.decisions.back().choice, "hard");
  EXPECT_EQ(count(off, "mesh_edges"), 0u);
  EXPECT_LE(count(off, "rays"), receivers());
  EXPECT_TRUE(off.setup.empty());
}

TEST_F(EffectsTest, WithoutCertificatesNoEdgeIsLookedAt) {
  const MethodResult off = see({{"effect-certificates", "off"}, {"max-error", 0.05}});
  EXPECT_EQ(off.decisions.back().choice, "reference");
  EXPECT_EQ(count(off, "mesh_edges"), 0u);
  EXPECT_TRUE(off.setup.empty()) << "no hierarchy of edges";
  EXPECT_TRUE(std::ranges::all_of(off.region, [](std::int8_t region) { return region == -1; }));
}

TEST_F(EffectsTest, WithoutAreasNoneIsIntegratedAndWithThemAllAre) {
  const OptionValues certified{{"effect-certificates", "on"}, {"max-error", 0.05}};
  OptionValues off = certified, on = certified;
  off["effect-areas"] = "off";
  on["effect-areas"] = "on";
  const MethodResult by_rays = see(off), by_areas = see(on);
  EXPECT_EQ(by_rays.decisions.back().choice, "rays");
  EXPECT_EQ(count(by_rays, "integrated"), 0u);
  EXPECT_GT(count(by_rays, "open"), 0u);
  EXPECT_EQ(by_areas.decisions.back().choice, "silhouette");
  EXPECT_GT(count(by_areas, "integrated"), 0u);
  EXPECT_EQ(count(by_areas, "open"), 0u);
}

// A plate that is divided so finely that merging leaves hardly more than its sides.
TEST_F(EffectsTest, WithoutMergingNoReceiverLooksAtMergedFaces) {
  scene_.objects = {{.name = "plate", .mesh = make_plane(1.0, 48)}, scene_.objects.back()};
  std::vector<Vec3> points(scene_.objects[0].mesh.positions().begin(),
                           scene_.objects[0].mesh.positions().end());
  for (Vec3& p : points) p.y += 1.0;
  scene_.objects[0].mesh = TriangleMesh::build(points, scene_.objects[0].mesh.triangles());
  const Casters plate(scene_.objects);
  const auto merged = [&](const char* merging) {
    return count(see(plate, {{"effect-areas", "on"}, {"effect-merging", merging}}), "merged_receivers");
  };
  EXPECT_GT(merged("on"), 0u);
  EXPECT_EQ(merged("off"), 0u);
}

TEST_F(EffectsTest, CastersThatReachNobodyAreLeftOutWhereThatIsOn) {
  OptionValues options{{"effect-areas", "on"}};
  options["effect-culling"] = "off";
  const std::uint64_t all = count(see(options), "hierarchy_bytes");
  options["effect-culling"] = "on";
  const Casters others(scene_.objects);  // for which nothing has been made that could be used again
  EXPECT_LT(count(see(others, options), "hierarchy_bytes"), all) << "without the box's edges";
}

// What is forced on or off keeps the error that was asked for.
TEST_F(EffectsTest, WithEffectsForcedTheErrorIsKept) {
  const std::vector<float> truth =
      visibility(casters_, scene_.lights.front().shape, view_.surface.receivers(),
                 {.method = "reference", .options = {{"samples", std::uint64_t{4096}}}})
          .visibility;
  for (const OptionValues& options :
       {OptionValues{{"effect-areas", "on"}}, OptionValues{{"effect-areas", "off"}},
        OptionValues{{"effect-merging", "off"}}, OptionValues{{"effect-certificates", "off"}},
        OptionValues{{"effect-shadows", "on"},
                     {"effect-penumbra", "on"},
                     {"effect-culling", "on"},
                     {"effect-certificates", "on"},
                     {"effect-areas", "on"},
                     {"effect-merging", "on"}}}) {
    const std::vector<float> seen = see(options).visibility;
    double sum = 0.0, pixels = 0.0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
      if (!(truth[i] > 0.0f && truth[i] < 1.0f)) continue;
      sum += (seen[i] - truth[i]) * (seen[i] - truth[i]);
      pixels += 1.0;
    }
    ASSERT_GT(pixels, 300.0);
    EXPECT_LE(std::sqrt(sum / pixels), PlanRequest{}.max_error) << options.begin()->first;
  }
}

TEST_F(EffectsTest, EffectsThatLeaveNoMethodAreRefused) {
  EXPECT_THROW(see({{"effect-certificates", "off"}, {"effect-areas", "on"}}), UsageError);
}

// A given plan is done, whatever is measured.
TEST_F(EffectsTest, AGivenPlanIsDone) {
  const LightShape& light = scene_.lights.front().shape;
  LightPlan plan;
  plan.method = "rays";
  plan.options = {{"samples", std::uint64_t{9}}};
  plan.left_out = {1};
  const std::unique_ptr<Method> method = given_plan_method({light}, {plan}).make(scene_);
  const Progress progress;
  const OptionValues none;
  const auto run = [&](const LightShape& lit) {
    return method->run({.rays = view_.rays,
                        .light = lit,
                        .receivers = view_.surface.receivers(),
                        .options = none,
                        .progress = progress});
  };
  Scene without = scene_;
  without.objects[1].casts = false;
  const MethodResult expected = visibility(Casters(without.objects), light, view_.surface.receivers(),
                                           {.method = "rays", .options = {{"samples", std::uint64_t{9}}}});
  EXPECT_EQ(run(light).visibility.size(), expected.visibility.size());
  EXPECT_EQ(count(run(light), "mesh_edges"), count(expected, "mesh_edges"));
  EXPECT_THROW(run(DiskLight{{0, 9, 0}, {0, -1, 0}, 0.5}), UsageError) << "there is no plan for it";
}

}  // namespace
}  // namespace penumbra
