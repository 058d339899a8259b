#include "render/scene/scene_limits.h"

#include <gtest/gtest.h>

#include "penumbra/mesh/error.h"
#include "penumbra/mesh/shapes.h"
#include "penumbra/render/scene/scene.h"

namespace penumbra {
namespace {

using detail::out_of_range;

Scene boxes(double size) {
  Scene scene;
  scene.lights.push_back(
      {.shape = DiskLight{.center = size * Vec3(0, 4, 0), .normal = {0, -1, 0}, .radius = size}});
  scene.camera.eye = size * Vec3(1, 2, 3);
  scene.objects.push_back({.name = "box", .mesh = make_box(Vec3(0.0), Vec3(size))});
  scene.objects.push_back(
      {.name = "floor", .mesh = make_box(Vec3(0, -2 * size, 0), Vec3(size)), .casts = false});
  return scene;
}

TEST(SceneLimits, ScenesOfAnySizeAreWithin) {
  for (const double size : {1e-90, 1e-20, 1.0, 1e20, 1e90}) EXPECT_EQ(out_of_range(boxes(size)), "") << size;
}

TEST(SceneLimits, WhatIsTooFarIsNamed) {
  const auto expect = [](const Scene& scene, const std::string& begin) {
    EXPECT_EQ(out_of_range(scene).substr(0, begin.size()), begin);
  };
  for (const double size : {1e-30, 1.0, 1e30}) {
    Scene scene = boxes(size);
    scene.camera.eye.x = 9e14 * size;
    expect(scene, "");
    scene.camera.eye.x = -2e15 * size;
    expect(scene,
           "/camera/eye: the camera is farther from what casts shadows than 1e+15 times its size (about ");
    scene = boxes(size);
    scene.lights[0].shape =
        DiskLight{.center = size * Vec3(0, 2e15, 0), .normal = {0, -1, 0}, .radius = size};
    expect(scene, "/lights/0: the light");
    scene.lights[0].shape =
        DiskLight{.center = size * Vec3(0, 4, 0), .normal = {0, -1, 0}, .radius = 2e15 * size};
    expect(scene, "/lights/0: the light");
    scene.lights[0].shape = DistantLight{.direction = {0, -1, 0}, .angle_degrees = 1};
    expect(scene, "");
    scene.objects[1].mesh = make_box(size * Vec3(0, -2, 0), size * Vec3(2e15, 1, 1));
    expect(scene, "/objects/1: the object");
  }
}

TEST(SceneLimits, AreAskedWhereScenesAreRead) {
  const auto message = [](const std::string& eye) {
    const std::string text =
        R"({"version":1, "objects":[{"mesh":"scenes/cube.off"}], "camera":{"target":[0,0,0],"eye":)" + eye +
        R"(},
        "lights":[{"shape":"disk","center":[0,4,0],"normal":[0,-1,0],"radius":0.5}]})";
    try {
      parse_scene(text, PENUMBRA_DATA, "s.json");
    } catch (const SceneError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(message("[1e9, 3, 5]"), "");
  EXPECT_EQ(message("[1e20, 3, 5]").find("s.json: /camera/eye: the camera is farther"), 0u);
  EXPECT_EQ(message("[1e101, 3, 5]").find("s.json: /camera/eye/0: is 1e+101, beyond 1e+100"), 0u);
}

}  // namespace
}  // namespace penumbra
