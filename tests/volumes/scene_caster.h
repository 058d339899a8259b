// The casters of data/scenes, each moved to its place, with the scene's light.
#pragma once

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "penumbra/mesh/io/polygon_soup.h"
#include "penumbra/mesh/triangle_mesh.h"
#include "penumbra/volumes/disk_light.h"

namespace penumbra::testing {

struct SceneCaster {
  std::string name;
  TriangleMesh mesh;
  DiskLight light;
  Bounds scene;  ///< casters, receivers and light
};

inline Vec3 to_vec(const nlohmann::json& j) {
  return {j[0], j[1], j[2]};
}

inline TriangleMesh read_moved(const std::filesystem::path& path, const Vec3& by) {
  PolygonSoup soup = read_polygon_soup(path);
  for (Vec3& p : soup.positions) p += by;
  return TriangleMesh::build(soup.positions, triangulate(soup).triangles);
}

/// Scenes of data/scenes have one caster each and use no transform but translation.
inline SceneCaster load_scene(const std::string& name) {
  const std::filesystem::path folder = std::filesystem::path(PENUMBRA_DATA) / "scenes";
  std::ifstream in(folder / (name + ".json"));
  const nlohmann::json scene = nlohmann::json::parse(in);
  const nlohmann::json& light = scene["lights"][0];
  SceneCaster result{name, {}, {to_vec(light["center"]), to_vec(light["normal"]), light["radius"]}, {}};
  for (const nlohmann::json& object : scene["objects"]) {
    const Vec3 by = object.contains("translation") ? to_vec(object["translation"]) : Vec3(0.0);
    const TriangleMesh mesh = read_moved(folder / object["mesh"].get<std::string>(), by);
    result.scene.add(bounds_of(mesh.positions()));
    if (object.value("casts", true)) result.mesh = mesh;
  }
  result.scene.add(result.light.center);
  return result;
}

/// Those under a disk.
inline std::vector<std::string> scene_names() {
  std::vector<std::string> names;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::filesystem::path(PENUMBRA_DATA) / "scenes")) {
    if (entry.path().extension() != ".json") continue;
    std::ifstream in(entry.path());
    if (nlohmann::json::parse(in)["lights"][0]["shape"] == "disk")
      names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

inline std::vector<std::filesystem::path> mesh_files() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::filesystem::path(PENUMBRA_DATA) / "meshes")) {
    if (entry.path().extension() == ".ply") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace penumbra::testing
