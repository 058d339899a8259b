#include "render/scene/gltf/gltf_scene.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>

#include "penumbra/mesh/error.h"
#include "render/scene/default_scene.h"
#include "render/scene/gltf/gltf_area_lights.h"
#include "render/scene/gltf/gltf_lights.h"
#include "render/scene/gltf/gltf_mesh.h"
#include "render/scene/gltf/gltf_nodes.h"
#include "render/scene/scene_limits.h"

namespace penumbra::detail {
namespace {

/// Of all objects together: more would not fit.
constexpr std::size_t kMostTriangles = std::size_t{1} << 28;

std::array<double, 12> key_of(const Transform& t) {
  const auto& [x, y, z] = t.columns;
  const Vec3& w = t.translation;
  return {x.x, x.y, x.z, y.x, y.y, y.z, z.x, z.y, z.z, w.x, w.y, w.z};
}

/// Makes objects of nodes.
class ObjectMaker {
 public:
  ObjectMaker(const GltfFile& file, std::optional<int> uv_set, GltfNotes& notes, LoadedScene& out)
      : file_(file), uv_set_(uv_set), notes_(notes), out_(out), meshes_(file.model.meshes.size()) {}

  void add(const PlacedNode& placed) {
    const tinygltf::Node& node = file_.model.nodes[placed.node];
    if (node.mesh < 0) return;
    const std::string where = "nodes[" + std::to_string(placed.node) + "]";
    if (static_cast<std::size_t>(node.mesh) >= meshes_.size())
      file_.fail(where, "has a mesh that does not exist", "export it again");
    const auto mesh = static_cast<std::size_t>(node.mesh);
    if (!meshes_[mesh].read) meshes_[mesh] = {true, read_gltf_mesh(file_, mesh, uv_set_, notes_), {}};
    if (!meshes_[mesh].entry) return;
    const std::string& name = node.name.empty() ? file_.model.meshes[mesh].name : node.name;
    for (const Transform& at : placed.instances)
      add(meshes_[mesh], at, name.empty() ? "mesh" + std::to_string(mesh) : name, where);
  }

 private:
  struct Mesh {
    bool read = false;
    std::optional<MeshCache::Entry> entry{};
    /// The object that stands at that place.
    std::map<std::array<double, 12>, std::size_t> placed{};
  };

  void add(Mesh& mesh, const Transform& at, const std::string& name, const std::string& where) {
    std::vector<SceneObject>& objects = out_.scene.objects;
    const auto [known, is_new] = mesh.placed.try_emplace(key_of(at), objects.size());
    if (!is_new) {
      objects.push_back(SceneObject(objects[known->second]));
      objects.back().name = name;
      return;
    }
    triangles_ += mesh.entry->triangulation.triangles.size();
    if (triangles_ > kMostTriangles)
      file_.fail(where, "makes more than 268 million triangles", "leave some out");
    SceneObject object{.name = name};
    try {
      object.mesh = place_mesh(*mesh.entry, at);
    } catch (const MeshError& e) {
      // A flattened or empty object hides nothing; coordinates that are no numbers are an error.
      if (std::string_view(e.what()).find("nothing is left") == std::string_view::npos)
        throw MeshError(file_.name + ": " + where + ": " + e.what());
      mesh.placed.erase(known);
      return notes_.ignore("meshes without a face of three distinct corners");
    }
    take_material_colors(*mesh.entry, object);
    take_normals(*mesh.entry, at, object);
    take_uv(*mesh.entry, at, object);
    if (const std::string summary = summary_of(*mesh.entry, object.mesh.report()); !summary.empty())
      out_.warnings.push_back(file_.name + ": " + where + ": " + summary);
    objects.push_back(std::move(object));
  }

  const GltfFile& file_;
  const std::optional<int> uv_set_;
  GltfNotes& notes_;
  LoadedScene& out_;
  std::vector<Mesh> meshes_;
  std::size_t triangles_ = 0;
};

void name_what_is_left_out(const GltfFile& file, GltfNotes& notes) {
  if (!file.model.animations.empty()) notes.ignore("animations");
  if (file.has_images) notes.ignore("textures");
  for (const std::string& extension : file.model.extensionsUsed)
    if (extension != "KHR_lights_punctual" && extension != kAreaLights &&
        extension != "KHR_mesh_quantization" && extension != "EXT_mesh_gpu_instancing")
      notes.ignore("extension " + extension.substr(0, 64));
}

}  // namespace

LoadedScene read_gltf(std::span<const std::byte> bytes, const std::filesystem::path& folder,
                      const std::string& name, const SceneOptions& options) {
  const GltfFile file = read_gltf_file(bytes, folder, name);
  LoadedScene out;
  GltfNotes notes;
  name_what_is_left_out(file, notes);
  const std::vector<PlacedNode> nodes = place_nodes(file, notes);
  ObjectMaker maker(file, options.uv_set, notes, out);
  for (const PlacedNode& node : nodes) maker.add(node);
  Scene& scene = out.scene;
  if (scene.objects.empty()) file.fail("", "has no triangles", "export it with its meshes");
  const Bounds bounds = scene.bounds();
  scene.lights = read_gltf_lights(file, nodes, bounds, options, notes, out.warnings);
  if (scene.lights.empty()) {
    const DistantLight sun{{-0.4, -1.0, -0.3}, options.sun_angle.value_or(0.53)};
    scene.lights.push_back({.shape = sun, .radiance = Vec3(3.0 / irradiance_per_radiance(sun))});
    out.warnings.push_back(name + ": has no lights (KHR_lights_punctual, EXT_lights_area); it gets a sun");
  }
  const std::optional<Camera> camera = read_gltf_camera(file, nodes, bounds, notes);
  scene.camera = camera ? *camera : camera_for(bounds);
  if (const std::string complaint = detail::out_of_range(scene); !complaint.empty())
    throw SceneError(name + ": " + complaint);
  scene.document = "{}";
  scene.files = file.files;
  if (const std::string text = notes.text(); !text.empty()) {
    if (options.strict) file.fail("", text, "leave them out, or read it without --strict");
    out.warnings.push_back(name + ": " + text);
  }
  return out;
}

}  // namespace penumbra::detail
