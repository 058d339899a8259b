// parse_scene: from a JSON document to a scene, key by key.
#include <cmath>
#include <glm/geometric.hpp>

#include "mesh/vectors.h"
#include "penumbra/mesh/error.h"
#include "penumbra/render/scene/scene.h"
#include "render/scene/default_scene.h"
#include "render/scene/scene_mesh.h"
#include "render/scene/scene_node.h"
#include "render/scene/transform.h"

namespace penumbra {
namespace {

using detail::SceneNode;
using detail::to_text;

void require_version_1(const SceneNode& root) {
  const SceneNode version = root.required("version");
  if (const double number = version.number(); number != 1.0)
    version.fail("is " + to_text(number) + "; this program reads version 1");
}

SceneNode only_light(const SceneNode& root) {
  const SceneNode lights = root.required("lights");
  const std::vector<SceneNode> nodes = lights.elements();
  if (nodes.empty()) lights.fail("is empty; add one light");
  if (nodes.size() > 1)
    lights.fail("has " + std::to_string(nodes.size()) + " lights; only one is supported, remove the others");
  return nodes.front();
}

// Sine of the angle between two vectors of any length; 0 where one of them is 0.
double sine_between(const Vec3& a, const Vec3& b) {
  return glm::length(glm::cross(detail::unit(a), detail::unit(b)));
}

void read_disk(const SceneNode& node, Scene& scene) {
  const SceneNode radius = node.required("radius");
  scene.light.radius = radius.number();
  if (scene.light.radius < 0.0) radius.fail("is " + to_text(scene.light.radius) + "; must be 0 or more");
}

void read_rectangle(const SceneNode& node, Scene& scene) {
  const SceneNode tangent = node.required("tangent"), extents = node.required("half_extents");
  const std::vector<double> half = extents.numbers(2);
  scene.rectangle = RectangleShape{tangent.vec3(), {half[0], half[1]}};
  if (sine_between(scene.rectangle->tangent, scene.light.normal) < 1e-9)
    tangent.fail("is 0 or parallel to normal; give the direction of one side");
  if (!(half[0] > 0.0 && half[1] > 0.0)) extents.fail("must be greater than 0");
  scene.light.radius = std::hypot(half[0], half[1]);
}

void read_light(const SceneNode& node, Scene& scene) {
  const SceneNode shape = node.required("shape");
  const std::string name = shape.text();
  if (name != "disk" && name != "rectangle")
    shape.fail("is \"" + name + "\"; only \"disk\" and \"rectangle\" are supported");
  const bool disk = name == "disk";
  if (disk)
    node.allow_only({"shape", "center", "normal", "radius", "radiance"});
  else
    node.allow_only({"shape", "center", "normal", "tangent", "half_extents", "radiance"});
  scene.light.center = node.required("center").vec3();
  const SceneNode normal = node.required("normal");
  scene.light.normal = normal.vec3();
  if (scene.light.normal == Vec3(0.0))
    normal.fail("has length 0; give the direction in which the light shines");
  if (disk)
    read_disk(node, scene);
  else
    read_rectangle(node, scene);
  if (const auto radiance = node.find("radiance")) {
    scene.radiance = radiance->number_or_vec3();
    if (scene.radiance.x < 0.0 || scene.radiance.y < 0.0 || scene.radiance.z < 0.0)
      radiance->fail("must not be negative");
  }
}

Camera read_camera(const SceneNode& node) {
  node.allow_only({"eye", "target", "up", "fov_y_degrees"});
  Camera camera;
  camera.eye = node.required("eye").vec3();
  const SceneNode target = node.required("target");
  camera.target = target.vec3();
  if (camera.eye == camera.target) target.fail("equals eye; the camera needs a direction to look in");
  const auto up = node.find("up");
  if (up) camera.up = up->vec3();
  if (sine_between(camera.up, camera.target - camera.eye) < 1e-9)
    (up ? *up : node).fail("up is 0 or parallel to the line of sight; choose another up");
  if (const auto fov = node.find("fov_y_degrees")) {
    camera.fov_y_degrees = fov->number();
    if (!(camera.fov_y_degrees > 0.0 && camera.fov_y_degrees < 180.0))
      fov->fail("is " + to_text(camera.fov_y_degrees) + "; must be between 0 and 180 degrees");
  }
  return camera;
}

TriangleMesh read_object_mesh(const SceneNode& node, const SceneNode& mesh_node,
                              const std::filesystem::path& folder, detail::MeshCache& meshes) {
  const std::string name = mesh_node.text();
  if (name.empty()) mesh_node.fail("is empty; name a mesh file");
  const detail::Transform transform = detail::read_transform(node);
  try {
    const detail::MeshCache::Entry& entry = meshes.get(folder / name);
    TriangleMesh mesh = detail::place_mesh(entry, transform);
    const std::string summary = detail::summary_of(entry.triangulation, mesh.report());
    if (!summary.empty()) mesh_node.warn(name + ": " + summary);
    return mesh;
  } catch (const MeshError& e) {
    throw MeshError(mesh_node.located(e.what()));
  }
}

SceneObject read_object(const SceneNode& node, const std::filesystem::path& folder,
                        detail::MeshCache& meshes) {
  node.allow_only({"mesh", "matrix", "translation", "rotation", "scale", "albedo", "casts"});
  const SceneNode mesh = node.required("mesh");
  SceneObject object{.name = mesh.text(), .mesh = read_object_mesh(node, mesh, folder, meshes)};
  if (const auto albedo = node.find("albedo")) {
    object.albedo = albedo->number_or_vec3();
    for (int i = 0; i < 3; ++i)
      if (object.albedo[i] < 0.0 || object.albedo[i] > 1.0) albedo->fail("must lie between 0 and 1");
  }
  if (const auto casts = node.find("casts")) object.casts = casts->boolean();
  return object;
}

}  // namespace

LoadedScene parse_scene(const nlohmann::json& document, const std::filesystem::path& folder,
                        const std::string& name, const SceneOptions& options) {
  detail::SceneNotes notes{.name = name, .strict = options.strict, .warnings = {}};
  const SceneNode root(document, nlohmann::json::json_pointer(), notes);
  root.allow_only({"version", "lights", "camera", "objects"});
  require_version_1(root);

  LoadedScene loaded;
  Scene& scene = loaded.scene;
  read_light(only_light(root), scene);
  const auto camera = root.find("camera");
  if (camera) scene.camera = read_camera(*camera);

  const SceneNode objects = root.required("objects");
  detail::MeshCache meshes;
  for (const SceneNode& node : objects.elements()) scene.objects.push_back(read_object(node, folder, meshes));
  if (scene.objects.empty()) objects.fail("is empty; add an object");
  if (!camera) scene.camera = detail::camera_for(scene.bounds());

  scene.document = document;
  loaded.warnings = std::move(notes.warnings);
  return loaded;
}

}  // namespace penumbra
