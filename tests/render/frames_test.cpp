// While the light moves and the camera stays, what depends on neither is kept, and every frame is the one
// that is made afresh.
#include <gtest/gtest.h>

#include "penumbra/render/renderer.h"
#include "tests/render/render_support.h"

namespace penumbra {
namespace {

constexpr int kFrames = 6;

Light moved(const Light& from, int frame) {
  Light light = from;
  auto& disk = std::get<DiskLight>(light.shape);
  disk.center += 0.04 * frame * Vec3(1.0, 0.3, -0.7);
  return light;
}

RenderOptions options_of(const std::string& method) {
  return {.method = method, .width = 150, .height = 110};
}

/// Frames of a moving light from one renderer into one result; `check(frame, result, fresh)` sees each beside
/// the same frame drawn afresh.
template <class Check>
void for_each_frame(const std::string& name, const RenderOptions& options, const Check& check) {
  Scene scene = testing::data_scene(name);
  const Light first = scene.lights[0];
  Renderer renderer(scene);
  RenderResult result;
  for (int frame = 0; frame < kFrames; ++frame) {
    scene.lights[0] = moved(first, frame);
    renderer.set_light(0, scene.lights[0]);
    renderer.render(options, result);
    check(frame, result, render(scene, options));
  }
}

void expect_same(const RenderResult& a, const RenderResult& b) {
  EXPECT_EQ(a.image.channels, b.image.channels);
  EXPECT_EQ(a.surface.position, b.surface.position);
  EXPECT_EQ(a.surface.normal, b.surface.normal);
  EXPECT_EQ(a.surface.object, b.surface.object);
  EXPECT_EQ(a.surface.face, b.surface.face);
}

double setup_of(const RenderResult& result) {
  double sum = 0.0;
  for (const StageTime& time : result.setup) sum += time.milliseconds;
  return sum;
}

TEST(Frames, OfAMovingLightAreThoseDrawnAfresh) {
  for (const char* method : {"silhouette", "auto", "rays", "hard"})
    for (const char* scene : {"cube-medium", "torus-medium", "bunny-medium"}) {
      SCOPED_TRACE(std::string(method) + " " + scene);
      for_each_frame(scene, options_of(method), [](int, const RenderResult& kept, const RenderResult& fresh) {
        expect_same(kept, fresh);
      });
    }
}

// The camera's rays, hierarchies and groups of receivers are those of the first frame.
TEST(Frames, OfAMovingLightSendNoRayOfTheCameraAndBuildNothing) {
  double setup = 0.0;
  for_each_frame("bunny-medium", options_of("silhouette"),
                 [&](int frame, const RenderResult& kept, const RenderResult& fresh) {
                   EXPECT_EQ(kept.camera_rays, frame == 0 ? 150u * 110u : 0u) << frame;
                   EXPECT_EQ(fresh.camera_rays, 150u * 110u);
                   if (frame == 0) setup = setup_of(kept);
                   EXPECT_GT(setup, 0.0);
                   EXPECT_EQ(setup_of(kept), setup) << frame;
                   const Count* groupings = find(kept.lights[0].counts, "groupings");
                   ASSERT_TRUE(groupings);
                   EXPECT_EQ(std::get<std::uint64_t>(groupings->value), 1u) << frame;
                 });
}

TEST(Frames, OfSeveralSamplesKeepTheRaysOfEach) {
  for (const int antialias : {2, 3}) {
    RenderOptions options = options_of("silhouette");
    options.antialias = antialias;
    const auto samples = static_cast<std::uint64_t>(antialias * antialias + (antialias % 2 == 0 ? 1 : 0));
    for_each_frame(
        "torus-medium", options, [&](int frame, const RenderResult& kept, const RenderResult& fresh) {
          expect_same(kept, fresh);
          EXPECT_EQ(kept.camera_rays, frame == 0 ? samples * 150 * 110 : 0u) << antialias << ", " << frame;
        });
  }
}

TEST(Frames, AfterTheCameraMovedOrAllWasForgottenAreSeenAnew) {
  Scene scene = testing::data_scene("torus-medium");
  Renderer renderer(scene);
  RenderOptions options = options_of("silhouette");
  RenderResult result;
  const auto expect_fresh = [&](const char* what) {
    SCOPED_TRACE(what);
    renderer.render(options, result);
    EXPECT_EQ(result.camera_rays, static_cast<std::uint64_t>(options.width * options.height));
    expect_same(result, render(scene, options));
  };
  expect_fresh("new");
  scene.camera.eye.x += 0.1;
  renderer.set_camera(scene.camera);
  expect_fresh("another camera");
  options.width = 90;
  expect_fresh("another size");
  renderer.forget();
  expect_fresh("forgotten");
  renderer.render(options, result);
  EXPECT_EQ(result.camera_rays, 0u);
}

// A result of another scene, with other channels, is as good as a new one.
TEST(Frames, MayUseTheMemoryOfAnyResult) {
  const Scene one = testing::data_scene("torus-medium");
  Scene two = testing::data_scene("cube-medium");
  two.lights.push_back(moved(two.lights[0], 5));
  two.lights[0].name = "left", two.lights[1].name = "right";
  const RenderOptions options = options_of("silhouette");
  Renderer first(one), second(two);
  RenderResult result;
  for (int i = 0; i < 2; ++i) {
    first.render(options, result);
    expect_same(result, render(one, options));
    second.render(options, result);
    expect_same(result, render(two, options));
  }
}

}  // namespace
}  // namespace penumbra
