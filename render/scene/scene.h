// A scene: one light, a camera, objects in world space. Read from JSON (or a bare mesh file), with
// warnings for what was not understood.
#pragma once

#include <filesystem>
#include <glm/vec2.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "penumbra/mesh/triangle_mesh.h"
#include "penumbra/render/scene/camera.h"
#include "penumbra/volumes/disk_light.h"

namespace penumbra {

struct SceneObject {
  std::string name;   ///< the mesh's path as the scene file has it
  TriangleMesh mesh;  ///< world space
  Vec3 albedo{0.8};   ///< linear RGB
  bool casts = true;
};

/// A rectangular light: its sides run along `tangent` and along normal × tangent.
struct RectangleShape {
  Vec3 tangent{
      1.0, 0.0,
      0.0};  ///< of any length, not parallel to the light's normal; only its part in the plane counts
  glm::dvec2 half_extents{0.5};  ///< along tangent and across it, scene units, > 0
};

struct Scene {
  DiskLight light;  ///< of a rectangle the disk around it: center and normal are its own
  std::optional<RectangleShape> rectangle;  ///< the light is this, not the disk (area_light.h)
  Vec3 radiance{10.0};  ///< linear RGB, W/(m² sr) if a scene unit is a metre; at radius 0 the intensity, W/sr
  Camera camera;
  std::vector<SceneObject> objects;
  nlohmann::json document;  ///< the file as read, keys beginning with `x-` included

  Bounds bounds() const;         ///< of all objects
  Bounds caster_bounds() const;  ///< of the objects that cast
};

struct SceneOptions {
  bool strict = false;  ///< unknown keys are errors, not warnings
};

struct LoadedScene {
  Scene scene;
  std::vector<std::string>
      warnings;  ///< one line each: unknown keys, what meshes needed (faces left out, split vertices)
};

/// Reads a scene file (*.json) or makes a scene of a bare mesh: the mesh on a floor that does not cast, with
/// a light and a camera that suit its bounds. Relative mesh paths start at the scene file's folder. Throws
/// SceneError or MeshError.
LoadedScene load_scene(const std::filesystem::path& path, const SceneOptions& options = {});

/// The same from a parsed document; `folder` is where relative mesh paths start, `name` is used in messages.
LoadedScene parse_scene(const nlohmann::json& document, const std::filesystem::path& folder,
                        const std::string& name, const SceneOptions& options = {});

}  // namespace penumbra
