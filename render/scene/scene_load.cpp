// load_scene and parse_scene: from a file or its text to a JSON document or a bare mesh.
#include <algorithm>
#include <fstream>
#include <span>
#include <utility>

#include "mesh/io/cursor.h"
#include "mesh/io/formats.h"
#include "mesh/io/read_file.h"
#include "penumbra/mesh/error.h"
#include "penumbra/mesh/io/polygon_soup.h"
#include "penumbra/render/scene/scene.h"
#include "render/scene/default_scene.h"
#include "render/scene/gltf/gltf_file.h"
#include "render/scene/gltf/gltf_scene.h"
#include "render/scene/scene_json.h"
#include "render/scene/scene_mesh.h"

namespace penumbra {
namespace {

// A scene names its meshes, it does not hold them: more than this is no scene.
constexpr std::size_t kMaxSceneBytes = 16u << 20;
// A scene nests four deep; the rest is room for `x-` keys. Copying and writing JSON recurse, so depth must
// have an end.
constexpr int kMaxDepth = 64;

std::string read_scene_text(const std::filesystem::path& path) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored))
    throw SceneError(path.string() + ": no such file; check the path of the scene");
  if (std::filesystem::is_directory(path, ignored))
    throw SceneError(path.string() + ": is a folder; name the scene file in it");
  std::ifstream in(path, std::ios::binary);
  if (!in) throw SceneError(path.string() + ": cannot be opened; check its permissions");
  std::string text;
  char block[1 << 16];
  while (in.read(block, sizeof block) || in.gcount() > 0) {
    text.append(block, static_cast<std::size_t>(in.gcount()));
    if (text.size() > kMaxSceneBytes)
      throw SceneError(path.string() +
                       ": is larger than 16 MiB, no scene file; keep large data in mesh files");
  }
  if (text.empty()) throw SceneError(path.string() + ": is empty; a scene file holds one JSON object");
  return text;
}

nlohmann::json parse_document(std::string_view text, const std::string& name) {
  const auto limit_depth = [&name](int depth, nlohmann::json::parse_event_t, nlohmann::json&) {
    if (depth > kMaxDepth)
      throw SceneError(name + ": nests deeper than " + std::to_string(kMaxDepth) + " levels; flatten it");
    return true;
  };
  try {
    return nlohmann::json::parse(text, limit_depth);
  } catch (const nlohmann::json::exception& e) {
    std::string reason = e.what();  // "[json.exception.parse_error.101] parse error at line …"
    if (const auto end = reason.find("] "); end != std::string::npos) reason.erase(0, end + 2);
    throw SceneError(name + ": " + reason);
  }
}

bool is_scene_file(const std::filesystem::path& path) {
  return detail::lower_extension(path) == ".json";
}
bool is_gltf(const std::filesystem::path& path) {
  const std::string extension = detail::lower_extension(path);
  return extension == ".gltf" || extension == ".glb";
}

/// Colors of materials stand in the mesh's own file: the scene's document must not replace them.
void take_colors(const detail::MeshCache::Entry& entry, Scene& scene) {
  SceneObject& object = scene.objects.back();
  const Vec3 before = object.albedo;
  detail::take_material_colors(entry, object);
  if (object.face_albedo.of_face.empty() && object.albedo == before) return;
  nlohmann::json document = nlohmann::json::parse(scene.document);
  document["objects"][0].erase("albedo");
  scene.document = document.dump();
}

LoadedScene scene_of(PolygonSoup soup, const std::string& name) {
  detail::MeshCache::Entry entry = detail::MeshCache::entry_of(std::move(soup));
  TriangleMesh mesh;
  try {
    mesh = detail::place_mesh(entry, {});
  } catch (const MeshError& e) {
    throw MeshError(name + ": " + e.what());
  }
  LoadedScene loaded{.scene = detail::scene_around(mesh, name), .warnings = {}};
  take_colors(entry, loaded.scene);
  detail::take_normals(entry, {}, loaded.scene.objects.back());
  loaded.scene.files = std::move(entry.files);
  const std::string summary = detail::summary_of(entry, mesh.report());
  if (!summary.empty()) loaded.warnings.push_back(name + ": " + summary);
  return loaded;
}

}  // namespace

LoadedScene load_scene(const std::filesystem::path& path, const SceneOptions& options) {
  LoadedScene loaded = [&] {
    if (is_scene_file(path))
      return parse_scene(read_scene_text(path), path.parent_path(), path.string(), options);
    if (is_gltf(path))
      return detail::read_gltf(detail::read_bytes(path), path.parent_path(), path.string(), options);
    return scene_of(read_polygon_soup(path), path.string());
  }();
  loaded.scene.files.insert(loaded.scene.files.begin(), path);
  return loaded;
}

LoadedScene parse_scene_or_mesh(std::string_view bytes, const std::filesystem::path& folder,
                                const std::string& name, const SceneOptions& options) {
  const auto raw = std::as_bytes(std::span(bytes));
  if (detail::begins_like_glb(raw)) return detail::read_gltf(raw, folder, name, options);
  const std::string_view text = detail::without_mark(bytes);
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first == text.npos || text[first] != '{') return scene_of(parse_polygon_soup(raw, name), name);
  if (bytes.size() > kMaxSceneBytes)
    throw SceneError(name + ": is larger than 16 MiB, no scene file; keep large data in mesh files");
  return parse_scene(bytes, folder, name, options);
}

LoadedScene parse_scene(std::string_view text, const std::filesystem::path& folder, const std::string& name,
                        const SceneOptions& options) {
  return detail::read_scene(parse_document(text, name), folder, name, options);
}

}  // namespace penumbra
