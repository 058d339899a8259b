// Key by key.
#include "render/scene/scene_json.h"

#include <cmath>
#include <span>

#include "mesh/corner_normals.h"
#include "penumbra/mesh/error.h"
#include "render/scene/default_scene.h"
#include "render/scene/heightfield/height_tiles.h"
#include "render/scene/scene_lights.h"
#include "render/scene/scene_limits.h"
#include "render/scene/scene_mesh.h"
#include "render/scene/scene_node.h"
#include "render/scene/transform.h"

namespace penumbra::detail {
namespace {

void require_version_1(const SceneNode& root) {
  const SceneNode version = root.required("version");
  if (const double number = version.number(); number != 1.0)
    version.fail("is " + to_text(number) + "; this program reads version 1");
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
  if (are_parallel(camera.up, camera.target - camera.eye))
    (up ? *up : node).fail("up is 0 or parallel to the line of sight; choose another up");
  if (const auto fov = node.find("fov_y_degrees")) {
    camera.fov_y_degrees = fov->number();
    if (!(camera.fov_y_degrees > 0.0 && camera.fov_y_degrees < 180.0))
      fov->fail("is " + to_text(camera.fov_y_degrees) + "; must be between 0 and 180 degrees");
  }
  return camera;
}

constexpr double kSameSurface = 0.5;  // cosine of 60 degrees

/// For a mesh whose file has none.
void make_normals(SceneObject& object) {
  const auto normals = corner_normals(object.mesh.positions(), object.mesh.triangles(), kSameSurface);
  for (const auto& [a, b, c] : normals)
    object.corner_normals.push_back({glm::vec3(a), glm::vec3(b), glm::vec3(c)});
}

/// Fills the object's mesh, the colors of its materials and its normals.
void read_object_mesh(const SceneNode& node, const SceneNode& mesh_node, const std::filesystem::path& folder,
                      MeshCache& meshes, SceneObject& object) {
  const std::string name = mesh_node.text();
  if (name.empty()) mesh_node.fail("is empty; name a mesh file");
  const Transform transform = read_transform(node);
  try {
    const MeshCache::Entry& entry = meshes.get(folder / name);
    object.mesh = place_mesh(entry, transform);
    take_material_colors(entry, object);
    const auto smooth = node.find("smooth");
    if (!smooth || smooth->boolean()) take_normals(entry, transform, object);
    if (smooth && smooth->boolean() && object.corner_normals.empty()) make_normals(object);
    const std::string summary = summary_of(entry, object.mesh.report());
    if (!summary.empty()) mesh_node.warn(name + ": " + summary);
  } catch (const MeshError& e) {
    throw MeshError(mesh_node.located(e.what()));
  }
}

SceneObject::Fade read_fade(const SceneNode& node) {
  const std::vector<double> ends = node.numbers(2);
  if (!(0.0 <= ends[0] && ends[0] < ends[1])) node.fail("must be two distances, the second one greater");
  return {ends[0], ends[1]};
}

/// All but the shape.
void read_looks(const SceneNode& node, SceneObject& object) {
  if (const auto albedo = node.find("albedo")) {
    object.albedo = albedo->number_or_vec3();
    object.face_albedo = {};
    for (int i = 0; i < 3; ++i)
      if (object.albedo[i] < 0.0 || object.albedo[i] > 1.0) albedo->fail("must lie between 0 and 1");
  }
  if (const auto casts = node.find("casts")) object.casts = casts->boolean();
  if (const auto catcher = node.find("shadow_catcher")) object.shadow_catcher = catcher->boolean();
  if (const auto fade = node.find("fade")) object.fade = read_fade(*fade);
}

SceneObject read_mesh_object(const SceneNode& node, const std::filesystem::path& folder, MeshCache& meshes) {
  node.allow_only({"mesh", "matrix", "translation", "rotation", "scale", "albedo", "smooth", "casts",
                   "shadow_catcher", "fade"});
  const SceneNode mesh = node.required("mesh");
  SceneObject object{.name = mesh.text()};
  read_object_mesh(node, mesh, folder, meshes, object);
  read_looks(node, object);
  return object;
}

std::size_t read_tile_side(const SceneNode& node) {
  constexpr double kMost = 4096.0;
  const double side = node.number();
  if (!(side >= 1.0 && side <= kMost && side == std::floor(side)))
    node.fail("is " + to_text(side) + "; must be a whole number from 1 to " + to_text(kMost));
  return static_cast<std::size_t>(side);
}

/// One object a tile, named FILE[ROW,COLUMN].
void add_heightfield(const SceneNode& node, const SceneNode& file, const std::filesystem::path& folder,
                     Scene& scene) {
  node.allow_only({"heightfield", "tile", "matrix", "translation", "rotation", "scale", "albedo", "smooth",
                   "casts", "shadow_catcher", "fade"});
  const std::string name = file.text();
  if (name.empty()) file.fail("is empty; name a file of heights");
  SceneObject object;
  read_looks(node, object);
  TileOptions options;
  if (const auto tile = node.find("tile")) options.side = read_tile_side(*tile);
  if (const auto smooth = node.find("smooth")) options.smooth = smooth->boolean();
  const Transform transform = read_transform(node);
  const std::size_t first = scene.objects.size();
  try {
    for (HeightTile& tile : make_tiles(read_heights(folder / name), transform, options)) {
      SceneObject& added = scene.objects.emplace_back(object);
      added.name = name + "[" + std::to_string(tile.row) + "," + std::to_string(tile.column) + "]";
      added.mesh = std::move(tile.mesh);
      added.corner_normals = std::move(tile.corner_normals);
    }
  } catch (const MeshError& e) {
    throw MeshError(file.located(e.what()));
  }
  const std::span tiles = std::span(scene.objects).subspan(first);
  Bounds whole;
  for (const SceneObject& tile : tiles) whole.add(tile.mesh.bounds());
  for (SceneObject& tile : tiles) tile.fade.middle = whole.center();
  scene.files.push_back(folder / name);
}

Background read_background(const SceneNode& node) {
  try {
    return parse_background(node.text());
  } catch (const UsageError& e) {
    node.fail(e.what());
  }
}

int read_antialias(const SceneNode& node) {
  const double samples = node.number();
  if (!(samples >= 1.0 && samples <= kMostAntialias && samples == std::floor(samples)))
    node.fail("is " + to_text(samples) + "; must be a whole number from 1 to " +
              std::to_string(kMostAntialias));
  return static_cast<int>(samples);
}

PictureSettings read_picture(const SceneNode& root) {
  PictureSettings picture;
  if (const auto ambient = root.find("ambient")) {
    picture.ambient = ambient->number_or_vec3();
    for (int i = 0; i < 3; ++i)
      if (picture.ambient[i] < 0.0) ambient->fail("must not be negative");
  }
  if (const auto background = root.find("background")) picture.background = read_background(*background);
  if (const auto antialias = root.find("antialias")) picture.antialias = read_antialias(*antialias);
  return picture;
}

}  // namespace

LoadedScene read_scene(const nlohmann::json& document, const std::filesystem::path& folder,
                       const std::string& name, const SceneOptions& options) {
  SceneNotes notes{.name = name, .strict = options.strict, .warnings = {}};
  const SceneNode root(document, nlohmann::json::json_pointer(), notes);
  root.allow_only({"version", "lights", "camera", "objects", "ambient", "background", "antialias"});
  require_version_1(root);

  LoadedScene loaded;
  Scene& scene = loaded.scene;
  scene.lights = read_lights(root);
  const auto camera = root.find("camera");
  if (camera) scene.camera = read_camera(*camera);
  scene.picture = read_picture(root);

  const SceneNode objects = root.required("objects");
  MeshCache meshes;
  for (const SceneNode& node : objects.elements())
    if (const auto heights = node.find("heightfield"))
      add_heightfield(node, *heights, folder, scene);
    else
      scene.objects.push_back(read_mesh_object(node, folder, meshes));
  if (scene.objects.empty()) objects.fail("is empty; add an object");
  for (const std::filesystem::path& file : meshes.files()) scene.files.push_back(file);
  if (!camera) scene.camera = camera_for(scene.bounds());

  if (const std::string complaint = out_of_range(scene); !complaint.empty())
    throw SceneError(name + ": " + complaint);

  scene.document = document.dump();
  loaded.warnings = std::move(notes.warnings);
  return loaded;
}

}  // namespace penumbra::detail
