// Lights that reach nothing: no time is spent on them, and the picture is the same.
#include <gtest/gtest.h>

#include "penumbra/render/renderer.h"
#include "tests/render/render_support.h"

namespace penumbra {
namespace {

/// A lamp over the scene; one below its floor that shines down, and one that faces away.
Scene with_dark_lights() {
  Scene scene = testing::data_scene("cube-medium");
  scene.lights.front().name = "lamp";
  scene.lights.push_back({.name = "below", .shape = DiskLight{{0, -3, 0}, {0, -1, 0}, 0.5}});
  scene.lights.push_back({.name = "away", .shape = DiskLight{{0, 20, 0}, {0, 1, 0}, 0.5}});
  return scene;
}

RenderOptions by(const char* method) {
  return {.method = method, .width = 96, .height = 72};
}

TEST(DarkLights, HaveTheChannelsThatTheyHaveByAnyMethod) {
  const Scene scene = with_dark_lights();
  RenderOptions options = by("auto");
  options.options["effect-areas"] = std::string("on");  // no rays, whose noise would be in R G B
  const RenderResult planned = render(scene, options), whole = render(scene, by("silhouette"));
  for (const std::size_t k : {1, 2}) {
    EXPECT_TRUE(planned.lights[k].is_dark) << scene.lights[k].name;
    EXPECT_EQ(planned.lights[k].visibility, whole.lights[k].visibility);
    const std::string name = scene.lights[k].name;
    EXPECT_EQ(planned.image.at("visibility." + name), whole.image.at("visibility." + name));
    EXPECT_EQ(planned.image.at("region." + name), whole.image.at("region." + name));
  }
  for (const char* channel : {"R", "G", "B", "A"}) {
    const std::vector<float>&a = planned.image.at(channel), &b = whole.image.at(channel);
    for (std::size_t i = 0; i < a.size(); ++i) ASSERT_NEAR(a[i], b[i], 1e-4f) << channel << i;
  }
  EXPECT_EQ(planned.warnings.size(), 2u);
}

TEST(DarkLights, AreLeftOutWhereThatIsAskedForAndAddedAfterwards) {
  const Scene scene = with_dark_lights();
  RenderOptions options = by("auto");
  const RenderResult whole = render(scene, options);
  options.leave_out_dark = true;
  RenderResult part = render(scene, options);
  EXPECT_TRUE(part.lights[1].visibility.empty());
  EXPECT_FALSE(part.image.channels.contains("visibility.below"));
  EXPECT_TRUE(part.image.channels.contains("visibility.lamp"));
  EXPECT_EQ(part.image.at("R"), whole.image.at("R"));
  EXPECT_EQ(part.warnings, whole.warnings);
  add_dark_channels(scene, part);
  EXPECT_EQ(part.image.channels, whole.image.channels);
}

// A light may turn dark and shine again while one result is used for all frames.
TEST(DarkLights, LeaveNothingBehindInAResultThatIsUsedAgain) {
  const Scene scene = with_dark_lights();
  for (const bool leave_out : {false, true}) {
    RenderOptions options = by("auto");
    options.leave_out_dark = leave_out;
    Renderer renderer(scene, 0);
    RenderResult result;
    for (const bool shines : {true, false, true}) {
      Light light = scene.lights[1];
      if (shines) light.shape = DiskLight{{1, 4, 0}, {0, -1, 0}, 0.5};
      renderer.set_light(1, light);
      renderer.render(options, result);
      EXPECT_EQ(result.lights[1].is_dark, !shines);
      EXPECT_EQ(result.image.channels, render(renderer.scene(), options).image.channels);
    }
  }
}

}  // namespace
}  // namespace penumbra
