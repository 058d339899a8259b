// Scenes by chance: a mesh of data/meshes, turned and placed over a floor, a disk light and a camera around
// it.
#pragma once

#include <array>
#include <filesystem>
#include <fstream>
#include <glm/gtc/quaternion.hpp>
#include <nlohmann/json.hpp>
#include <string>

#include "penumbra/mesh/inspect.h"
#include "tests/render/render_support.h"

namespace penumbra::testing {

struct Pose {
  std::string name;  ///< mesh and seed
  nlohmann::json scene;
};

/// A mesh of radius about 1 (half the diagonal of its bounds) whose lowest point is 0 to 0.4 above the floor;
/// the light 3 to 6 from it, 25° to 90° above the horizon, turned up to 30° away from it; radius 0.02 to 0.8.
inline Pose random_pose(const std::string& mesh_file, std::uint64_t seed) {
  Random random(seed);
  const auto meshes = std::filesystem::path(PENUMBRA_DATA);
  const LoadedScene loaded = load_scene(meshes / mesh_file);
  const TriangleMesh& mesh = loaded.scene.objects.back().mesh;
  const Bounds bounds = bounds_of(mesh.positions());
  const double scale = 2.0 / glm::length(bounds.high - bounds.low);
  const Vec3 axis = random.direction();
  const double half = 0.5 * random.uniform(0.0, kPi);
  const glm::dquat turn(std::cos(half), std::sin(half) * axis);
  double lowest = 1e300;
  for (const Vec3& p : mesh.positions())
    lowest = std::min(lowest, (turn * (scale * (p - bounds.center()))).y);
  const Vec3 middle{0.0, random.uniform(0.0, 0.4) - lowest, 0.0};
  const auto around = [&](double least, double most, double distance) {
    const double turn_y = random.uniform(0.0, 2.0 * kPi), up = random.uniform(least, most) * kPi / 180.0;
    return distance * Vec3{std::cos(up) * std::cos(turn_y), std::sin(up), std::cos(up) * std::sin(turn_y)};
  };
  const Vec3 light = middle + around(25.0, 90.0, random.uniform(3.0, 6.0));
  const Vec3 normal = glm::normalize(middle - light) + 0.5 * random.uniform(0.0, 1.0) * random.direction();
  const Vec3 eye = middle + around(15.0, 70.0, 4.5);
  const Vec3 shift = middle - turn * (scale * bounds.center());
  const auto list = [](const Vec3& v) { return nlohmann::json{v.x, v.y, v.z}; };
  nlohmann::json object = {{"mesh", (meshes / mesh_file).string()},
                           {"translation", list(shift)},
                           {"rotation", {turn.x, turn.y, turn.z, turn.w}},
                           {"scale", scale}};
  nlohmann::json floor = {{"mesh", (meshes / "scenes" / "floor.off").string()}, {"casts", false}};
  return {std::filesystem::path(mesh_file).stem().string() + "-" + std::to_string(seed),
          {{"version", 1},
           {"lights",
            {{{"shape", "disk"},
              {"center", list(light)},
              {"normal", list(normal)},
              {"radius", random.spread(0.02, 0.8)}}}},
           {"camera", {{"eye", list(eye)}, {"target", list(0.7 * middle)}, {"fov_y_degrees", 42}}},
           {"objects", {floor, object}}}};
}

/// Written to a file in the system's temporary folder (where it stays, to look at) and loaded from it.
inline Scene load_pose(const Pose& pose) {
  const auto file = std::filesystem::temp_directory_path() / ("penumbra-pose-" + pose.name + ".json");
  std::ofstream(file) << pose.scene.dump(1);
  return load_scene(file).scene;
}

}  // namespace penumbra::testing
