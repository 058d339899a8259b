// Lights inside, on and behind geometry, and lights that light nothing: the picture is right, and a warning
// says so.
#include <gtest/gtest.h>

#include "penumbra/render/renderer.h"
#include "tests/oracle/oracle.h"
#include "tests/render/render_support.h"

namespace penumbra {
namespace {

/// A box on a floor, both casting.
Scene box_on_floor(const LightShape& light) {
  Scene scene;
  scene.lights = {{.name = {}, .shape = light}};
  scene.camera = {{3, 4, 5}, {0, 0.4, 0}, {0, 1, 0}, 40};
  scene.objects.push_back({"floor", make_plane(3.0), Vec3(0.8), true});
  scene.objects.push_back({"box", make_box({0, 0.6, 0}, Vec3(0.5)), Vec3(0.8), true});
  return scene;
}

struct Named {
  const char* name;
  LightShape light;
  const char* warning;  ///< a part of it; empty: there is none
};

std::vector<Named> lights() {
  return {{"inside of the box", DiskLight{{0, 0.6, 0}, {0, -1, 0}, 0.2}, "casters hide"},
          {"half inside of it", DiskLight{{0.5, 0.6, 0}, {1, 0.2, 0}, 0.4}, ""},
          {"on its top, upwards", DiskLight{{0, 1.1, 0}, {0, 1, 0}, 0.3}, "behind the light's plane"},
          {"on its side", DiskLight{{0.5, 0.6, 0}, {1, 0, 0}, 0.3}, ""},
          {"below the floor", DiskLight{{0, -2, 0}, {0.1, 1, 0}, 0.5}, "faces away"},
          {"facing away", DiskLight{{0, 4, 0}, {0, 1, 0}, 0.5}, "behind the light's plane"},
          {"in the floor", DiskLight{{1, 0, 1}, {0, 1, 0}, 0.3}, ""},
          {"a lamp as usual", DiskLight{{1, 4, 1}, {0, -1, 0}, 0.5}, ""},
          {"a sun from below", DistantLight{{0.1, 1, 0.2}, 2.0}, "faces away"},
          {"a sun as usual", DistantLight{{0.3, -1, 0.2}, 2.0}, ""}};
}

/// V by the oracle, of every third pixel.
void expect_right(const Named& each, const Scene& scene, const RenderResult& result, double most) {
  std::vector<TriangleMesh> meshes;
  for (const SceneObject& object : scene.objects) meshes.push_back(object.mesh);
  const oracle::Oracle oracle{std::span(meshes)};
  const oracle::Light light = std::holds_alternative<DiskLight>(each.light)
                                  ? oracle::Light(std::get<DiskLight>(each.light))
                                  : oracle::Light(std::get<DistantLight>(each.light));
  const std::vector<float>& v = result.lights.front().visibility;
  for (std::size_t i = 0; i < result.surface.size(); i += 3) {
    if (!result.surface.hit(i)) continue;
    const oracle::CasterFace own{static_cast<std::uint32_t>(result.surface.object[i]),
                                 FaceId{result.surface.face[i]}};
    const double expected =
        oracle.visibility(result.surface.position[i], result.surface.normal[i], own, light, 256, i);
    ASSERT_NEAR(v[i], expected, most) << each.name << ", pixel " << i;
  }
}

TEST(Unlit, PicturesAreRightAndWarn) {
  for (const Named& each : lights()) {
    const Scene scene = box_on_floor(each.light);
    RenderOptions options;
    options.method = "reference";
    options.width = 80;
    options.height = 60;
    const RenderResult result = render(scene, options);
    expect_right(each, scene, result, 0.07);
    const std::string part = each.warning;
    ASSERT_EQ(result.warnings.size(), part.empty() ? 0u : 1u) << each.name;
    if (part.empty()) continue;
    EXPECT_NE(result.warnings[0].find(part), std::string::npos) << each.name << ": " << result.warnings[0];
    EXPECT_NE(result.warnings[0].find("the light lights nothing"), std::string::npos);
  }
}

TEST(Unlit, WarningsNameTheLight) {
  Scene scene = box_on_floor(DiskLight{{0, 4, 0}, {0, 1, 0}, 0.5});
  scene.lights[0].name = "up";
  scene.lights.push_back({.name = "down", .shape = DiskLight{{0, 4, 0}, {0, -1, 0}, 0.5}});
  RenderOptions options;
  options.method = "hard";
  options.width = 40;
  options.height = 30;
  const RenderResult result = render(scene, options);
  ASSERT_EQ(result.warnings.size(), 1u);
  EXPECT_EQ(result.warnings[0].rfind("light up lights nothing", 0), 0u) << result.warnings[0];
  scene.camera.target = {3, 9, 5};
  EXPECT_TRUE(render(scene, options).warnings.empty()) << "nothing is seen";
}

/// What is seen in front of it turns its back: a floor from below, a lamp above.
TEST(Unlit, WhatFacesAwayIsToldApart) {
  Scene scene;
  scene.lights = {{.name = {}, .shape = DiskLight{{0, 4, 0}, {0, -1, 0}, 0.5}}};
  scene.camera = {{0.5, -3, 0.2}, {0, 0, 0}, {0, 0, 1}, 30};
  scene.objects.push_back({"floor", make_plane(3.0), Vec3(0.8), false});
  RenderOptions options;
  options.method = "none";
  options.width = 40;
  options.height = 30;
  const RenderResult result = render(scene, options);
  ASSERT_EQ(result.warnings.size(), 1u);
  EXPECT_NE(result.warnings[0].find("faces away"), std::string::npos) << result.warnings[0];
}

}  // namespace
}  // namespace penumbra
