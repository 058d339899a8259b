// Distant lights in scene files.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numbers>

#include "penumbra/mesh/error.h"
#include "penumbra/render/scene/scene.h"
#include "render/light/area_light.h"

namespace penumbra {
namespace {

using Json = nlohmann::json;

constexpr double kPi = std::numbers::pi;

LoadedScene parsed(const Json& light, bool strict = true) {
  const Json document = {{"version", 1}, {"lights", {light}}, {"objects", {{{"mesh", "cube.off"}}}}};
  return parse_scene(document.dump(), std::filesystem::path(PENUMBRA_DATA) / "scenes", "s.json",
                     {.strict = strict});
}

Light light_of(const Json& light) {
  return parsed(light).scene.lights.at(0);
}

std::string message_of(const Json& light) {
  try {
    parsed(light);
  } catch (const SceneError& e) {
    return e.what();
  }
  return "no SceneError";
}

/// A sun with these keys as well.
Json sun(const Json& more = Json::object()) {
  Json light = {{"shape", "distant"}, {"direction", {1, -2, 0}}};
  light.update(more);
  return light;
}

TEST(DistantLights, AreRead) {
  const Light light = light_of(sun({{"name", "sun"}, {"angle_degrees", 60}, {"irradiance", {1, 2, 4}}}));
  EXPECT_EQ(light.name, "sun");
  EXPECT_EQ(std::get<DistantLight>(light.shape),
            (DistantLight{.direction = {1, -2, 0}, .angle_degrees = 60.0}));
  for (int k = 0; k < 3; ++k)  // sin² 30° is 1/4
    EXPECT_NEAR(light.radiance[k] * kPi / 4.0, std::exp2(k), 1e-14) << k;
  EXPECT_EQ(light_of(sun({{"radiance", {1, 2, 4}}})).radiance, Vec3(1, 2, 4)) << "as given";
  EXPECT_EQ(light_of(sun({{"irradiance", 0}})).radiance, Vec3(0.0));
}

TEST(DistantLights, HaveDefaults) {
  const Light light = light_of(sun());
  const DistantLight& shape = std::get<DistantLight>(light.shape);
  EXPECT_EQ(shape.angle_degrees, 0.53) << "the sun's";
  EXPECT_NEAR(light.radiance.x * irradiance_per_radiance(shape), 3.0, 1e-14);
}

// A point at infinity: no radiance, its irradiance takes the place.
TEST(DistantLights, OfAngleZeroHaveAnIrradiance) {
  const Light light = light_of(sun({{"angle_degrees", 0}, {"irradiance", {3, 2, 1}}}));
  EXPECT_TRUE(is_point(light.shape));
  EXPECT_EQ(light.radiance, Vec3(3, 2, 1));
  EXPECT_EQ(light_of(sun({{"angle_degrees", 0}})).radiance, Vec3(3.0));
}

TEST(DistantLights, ThatAreWrongAreRefusedByName) {
  const auto expect = [](const Json& light, const std::string& where, const std::string& what) {
    const std::string message = message_of(light);
    EXPECT_NE(message.find("s.json: /lights/0" + where + ": "), std::string::npos) << message;
    EXPECT_NE(message.find(what), std::string::npos) << message;
  };
  expect({{"shape", "distant"}}, "", "direction");
  expect(sun({{"direction", {0, 0, 0}}}), "/direction", "give the direction in which the light shines");
  for (const double angle : {-0.5, 180.0, 1e3})
    expect(sun({{"angle_degrees", angle}}), "/angle_degrees", "must be from 0 to below 180");
  expect(sun({{"irradiance", 3}, {"radiance", 3}}), "/irradiance", "give one of them");
  expect(sun({{"irradiance", {1, -1, 1}}}), "/irradiance", "must not be negative");
  expect(sun({{"radiance", -1}}), "/radiance", "must not be negative");
  expect(sun({{"angle_degrees", 0}, {"radiance", 3}}), "/radiance", "give irradiance");
  expect(sun({{"angle_degrees", 1e-160}}), "", "give an angle of 0");
  for (const char* key : {"center", "normal", "radius"}) expect(sun({{key, 1}}), std::string("/") + key, "");
  EXPECT_EQ(parsed(sun({{"radius", 1}}), false).warnings.size(), 1u);
}

TEST(DistantLights, AreADiskAtUnitDistanceForEveryReceiver) {
  const AreaLight light = area_light(DistantLight{.direction = {0, -3, 0}, .angle_degrees = 90.0});
  EXPECT_TRUE(light.disk);
  EXPECT_TRUE(light.distant);
  EXPECT_EQ(light.center, Vec3(0, 1, 0)) << "towards the light";
  EXPECT_EQ(light.axes.w, Vec3(0, -1, 0));
  EXPECT_NEAR(light.half.x, 1.0, 1e-15);
  EXPECT_EQ(light.half.x, light.half.y);
  for (const Vec3& x : {Vec3(0.0), Vec3(1e9, -7, 3), Vec3(0, 1e300, 0)}) {
    EXPECT_EQ(light.to_light(x), Vec3(0, 0, 1));
    EXPECT_EQ(light.from_receiver(x), Vec3(0, 1, 0));
    EXPECT_FALSE(light.is_behind(x));
  }
}

}  // namespace
}  // namespace penumbra
