// Lights as the viewer edits and saves them, without a window.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "apps/viewer/handles/light_handles.h"
#include "apps/viewer/state/state_file.h"
#include "apps/viewer/work/exports.h"

namespace penumbra::viewer {
namespace {

using Json = nlohmann::json;

constexpr const char* kScene = R"({"version":1, "lights":[
    {"name":"sun","shape":"distant","direction":[1,-2,1],"angle_degrees":0.5,"irradiance":[3,2,1],"x-mine":7},
    {"name":"lamp","shape":"disk","center":[0,4,0],"normal":[0,-1,0],"radius":0.5}],
  "objects":[{"mesh":"cube.off"}]})";

State opened_state() {
  const std::filesystem::path folder = std::filesystem::path(PENUMBRA_DATA) / "scenes";
  LoadedScene loaded = parse_scene(kScene, folder, "s.json", {.strict = true});
  return opened(folder / "s.json", loaded, {});
}

const DistantLight& sun_of(const State& state) {
  return std::get<DistantLight>(state.lights.at(0).shape);
}

double irradiance(const State& state) {
  return state.lights[0].radiance.x * irradiance_per_radiance(sun_of(state));
}

/// What a saved state has below "lights".
Json saved_lights(const State& state) {
  const auto path =
      std::filesystem::temp_directory_path() / ("penumbra-sun-" + std::to_string(getpid()) + ".json");
  save_state(path, state);
  std::ifstream file(path);
  const Json document = Json::parse(file);
  std::filesystem::remove(path);
  return document["lights"];
}

TEST(DistantHandles, StandBeforeTheCastersAndFaceThem) {
  const State state = opened_state();
  const HandledLight light = state.handled();
  ASSERT_TRUE(light.middle);
  EXPECT_EQ(*light.middle, state.casters.center());
  const double distance = glm::length(light.disk.center - *light.middle);
  EXPECT_NEAR(distance, 2.0 * state.casters.radius(), 1e-12);
  EXPECT_NEAR(glm::dot(glm::normalize(*light.middle - light.disk.center), glm::normalize(Vec3(1, -2, 1))),
              1.0, 1e-15);
  EXPECT_NEAR(light.disk.radius / distance, CircularLight(sun_of(state)).radius, 1e-15);
}

TEST(DistantHandles, TurnTheDirectionAndSetTheAngle) {
  State state = opened_state();
  const Camera camera{.eye = {3, 4, 7}, .target = {0.0, 1.0, 0.0}, .up = {0, 1, 0}, .fov_y_degrees = 60};
  const Projection projection(camera, 640, 480);
  const HandleShape shape = handle_shape(state.handled(), projection);
  EXPECT_TRUE(shape.axis_tips.empty()) << "it has no place";
  const std::pair<Handle, Vec3> places[] = {
      {Handle::kNormal, shape.normal_tip}, {Handle::kRim, shape.rim_knob}, {Handle::kCenter, shape.center}};
  for (const auto& [handle, place] : places) {
    state = opened_state();
    const PicturePoint at = *projection.project(place), to{at.x - 12, at.y + 5};
    EXPECT_EQ(pick(shape, projection, at), handle) << name_of(handle);
    const HandleDrag drag(handle, state.handled(), projection, at);
    state.set_handled(drag.moved_to(projection, at));
    EXPECT_NEAR(glm::distance(glm::normalize(sun_of(state).direction), glm::normalize(Vec3(1, -2, 1))), 0.0,
                1e-9)
        << "no jump, " << name_of(handle);
    state.set_handled(drag.moved_to(projection, to));
    EXPECT_EQ(sun_of(state).direction != Vec3(1, -2, 1), handle != Handle::kRim) << name_of(handle);
    EXPECT_EQ(sun_of(state).angle_degrees != 0.5, handle == Handle::kRim) << name_of(handle);
    EXPECT_NEAR(irradiance(state), 3.0, 1e-12) << name_of(handle);
    if (handle == Handle::kCenter) {  // it follows the pointer
      const auto now = projection.project(handle_shape(state.handled(), projection).center);
      EXPECT_LT(distance(*now, to), 0.5);
    }
  }
}

TEST(DistantHandles, AzimuthAndElevationAreWhereItIsSeen) {
  const Heading heading = heading_of({.direction = {-1, -1, 0}});
  EXPECT_NEAR(heading.azimuth, 90.0, 1e-12) << "it stands at +x";
  EXPECT_NEAR(heading.elevation, 45.0, 1e-12);
  EXPECT_NEAR(heading_of({.direction = {0, -1, 0}}).elevation, 90.0, 1e-12);
  for (double azimuth = -170.0; azimuth < 180.0; azimuth += 50.0)
    for (double elevation = -80.0; elevation < 90.0; elevation += 40.0) {
      const Heading back = heading_of({.direction = direction_from({azimuth, elevation})});
      EXPECT_NEAR(back.azimuth, azimuth, 1e-9);
      EXPECT_NEAR(back.elevation, elevation, 1e-9);
    }
}

TEST(DistantLightState, IsSavedAsItWasOrAsItIsNow) {
  State state = opened_state();
  EXPECT_EQ(saved_lights(state), Json::parse(kScene)["lights"]) << "as it was written";
  DistantLight light = sun_of(state);
  light.direction = {0, -1, 0};
  light.angle_degrees = 2.0;
  state.set_shape(light);
  Json lights = saved_lights(state);
  EXPECT_EQ(lights[1], Json::parse(kScene)["lights"][1]);
  EXPECT_EQ(lights[0]["direction"], Json({0.0, -1.0, 0.0}));
  EXPECT_EQ(lights[0]["angle_degrees"], 2.0);
  EXPECT_EQ(lights[0]["x-mine"], 7);
  EXPECT_FALSE(lights[0].contains("radiance"));
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(lights[0]["irradiance"][k].get<double>(), 3.0 - k, 1e-12);
  light.angle_degrees = 0.0;
  state.set_shape(light);
  EXPECT_NEAR(state.lights[0].radiance.x, 3.0, 1e-12) << "at angle 0 it is the irradiance";
  light.angle_degrees = 1.0;
  state.set_shape(light);
  EXPECT_NEAR(irradiance(state), 3.0, 1e-12);
}

TEST(DistantLightState, MovesOnAPathOfDirectionsAndAngles) {
  State state = opened_state();
  DistantLight light = sun_of(state);
  light.direction = {-1, -2, -1};
  light.angle_degrees = 1.0;
  state.set_shape(light);
  const auto at = [&](double t) {
    State moved = state;
    moved.set_handled(light_on_path(state, t));
    return sun_of(moved);
  };
  EXPECT_NEAR(at(0.0).angle_degrees, 0.5, 1e-9);
  EXPECT_NEAR(glm::dot(glm::normalize(at(0.0).direction), glm::normalize(Vec3(1, -2, 1))), 1.0, 1e-12);
  EXPECT_NEAR(at(0.5).angle_degrees, 0.75, 1e-3);
  EXPECT_NEAR(glm::normalize(at(0.5).direction).y, -1.0, 1e-12);
  EXPECT_EQ(at(1.0), light);
}

}  // namespace
}  // namespace penumbra::viewer
