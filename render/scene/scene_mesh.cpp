#include "render/scene/scene_mesh.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <utility>

#include "mesh/vectors.h"
#include "penumbra/mesh/error.h"
#include "render/scene/scene_limits.h"

namespace penumbra::detail {
namespace {

std::string counted(std::size_t count, const char* one, const char* many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

/// Whether a face of the mesh, which is the entry's under this transform, was turned round: its corners 1 and
/// 2 have then changed places.
bool is_turned(const MeshCache::Entry& entry, const Transform& transform, const TriangleMesh& mesh,
               std::uint32_t face) {
  const IndexedTriangle& read = entry.triangulation.triangles[mesh.source_triangles()[face]];
  return mesh.positions()[mesh.triangles()[face][1]] != transform.apply(entry.positions[read[1]]);
}

}  // namespace

const MeshCache::Entry& MeshCache::get(const std::filesystem::path& path) {
  std::error_code error;
  std::filesystem::path key = std::filesystem::weakly_canonical(path, error);
  if (error) key = path;
  if (const auto it = entries_.find(key); it != entries_.end()) return it->second;
  Entry& entry = entries_.emplace(key, entry_of(read_polygon_soup(path))).first->second;
  entry.files.insert(entry.files.begin(), path);
  return entry;
}

std::vector<std::filesystem::path> MeshCache::files() const {
  std::vector<std::filesystem::path> all;
  for (const auto& [key, entry] : entries_) all.insert(all.end(), entry.files.begin(), entry.files.end());
  return all;
}

MeshCache::Entry MeshCache::entry_of(PolygonSoup soup) {
  Entry entry{.positions = {},
              .triangulation = triangulate(soup),
              .materials = std::move(soup.materials),
              .polygon_material = std::move(soup.polygon_material),
              .normals = std::move(soup.normals),
              .corner_normals = std::move(soup.corner_normals),
              .ignored = std::move(soup.ignored),
              .files = std::move(soup.material_paths)};
  entry.positions = std::move(soup.positions);
  return entry;
}

TriangleMesh place_mesh(const MeshCache::Entry& entry, const Transform& transform) {
  std::vector<Vec3> positions;
  positions.reserve(entry.positions.size());
  for (const Vec3& p : entry.positions) {
    const Vec3 world = transform.apply(p);
    if (!(largest_component(world) <= kMostNumber))
      throw MeshError("a vertex lies beyond " + to_text(kMostNumber) + "; use another unit of length");
    positions.push_back(world);
  }
  std::vector<IndexedTriangle> triangles = entry.triangulation.triangles;
  if (transform.mirrors())
    for (IndexedTriangle& t : triangles) std::swap(t[1], t[2]);
  TriangleMesh mesh = TriangleMesh::build(positions, triangles);
  if (mesh.empty()) throw MeshError("no face has three distinct corners; nothing is left of the mesh");
  return mesh;
}

void take_material_colors(const MeshCache::Entry& entry, SceneObject& object) {
  if (std::ranges::none_of(entry.materials, [](const Material& m) { return m.color.has_value(); })) return;
  FaceColors faces;
  for (const Material& material : entry.materials)
    faces.colors.push_back(material.color.value_or(object.albedo));
  faces.colors.push_back(object.albedo);
  const auto none = static_cast<std::uint32_t>(entry.materials.size());
  for (const std::uint32_t source : object.mesh.source_triangles()) {
    const std::uint32_t material = entry.polygon_material[entry.triangulation.source_polygon[source]];
    faces.of_face.push_back(std::min(material, none));
  }
  const Vec3 first = faces.colors[faces.of_face[0]];
  if (std::ranges::all_of(faces.of_face, [&](std::uint32_t i) { return faces.colors[i] == first; })) {
    object.albedo = first;
  } else {
    object.face_albedo = std::move(faces);
  }
}

void take_normals(const MeshCache::Entry& entry, const Transform& transform, SceneObject& object) {
  if (entry.normals.empty()) return;
  const auto& [x, y, z] = transform.columns;
  // The transposed inverse but for its length: where the transform mirrors, cofactors point to the other
  // side.
  const double side = transform.mirrors() ? -1.0 : 1.0;
  const std::array<Vec3, 3> turned = {side * glm::cross(y, z), side * glm::cross(z, x),
                                      side * glm::cross(x, y)};
  const TriangleMesh& mesh = object.mesh;
  for (std::uint32_t f = 0; f < mesh.triangles().size(); ++f) {
    IndexedTriangle corners = entry.triangulation.corners[mesh.source_triangles()[f]];
    const auto position = [&](std::size_t k) { return mesh.positions()[mesh.triangles()[f][k]]; };
    if (is_turned(entry, transform, mesh, f)) std::swap(corners[1], corners[2]);
    const Vec3 flat = unit(glm::cross(position(1) - position(0), position(2) - position(0)));
    std::array<glm::vec3, 3>& normals = object.corner_normals.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t i = entry.corner_normals[corners[k]];
      const Vec3 n = i == PolygonSoup::kNoNormal ? Vec3(0.0) : scaled_to_one(entry.normals[i]);
      const Vec3 world = unit(turned[0] * n.x + turned[1] * n.y + turned[2] * n.z);
      normals[k] = glm::vec3(i == PolygonSoup::kNoNormal ? flat : world);
    }
  }
}

void take_uv(const MeshCache::Entry& entry, const Transform& transform, SceneObject& object) {
  if (entry.corner_uv.empty()) return;
  const TriangleMesh& mesh = object.mesh;
  for (std::uint32_t f = 0; f < mesh.triangles().size(); ++f) {
    const std::size_t first = 3 * std::size_t{entry.triangulation.source_polygon[mesh.source_triangles()[f]]};
    auto& uv = object.corner_uv.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) uv[k] = entry.corner_uv[first + k];
    if (is_turned(entry, transform, mesh, f)) std::swap(uv[1], uv[2]);
  }
}

std::string summary_of(const MeshCache::Entry& entry, const BuildReport& report) {
  const PolygonReport& polygons = entry.triangulation.report;
  std::string text;
  const auto add = [&text](const std::string& part) { text += (text.empty() ? "" : "; ") + part; };
  const std::size_t left_out = report.degenerate.size() + polygons.skipped;
  if (left_out) add("left out " + counted(left_out, "face", "faces") + " without three distinct corners");
  if (polygons.crossing)
    add("divided " +
        counted(polygons.crossing, "polygon that crosses itself", "polygons that cross themselves") +
        " from the first corner");
  if (report.joined_edges)
    add("joined faces in pairs at " + counted(report.joined_edges, "edge", "edges") + " with more than two");
  if (const std::size_t cut = report.non_manifold_edges - report.joined_edges)
    add("split at " + counted(cut, "edge", "edges") + " with more than two faces");
  if (report.misoriented_edges)
    add("split at " + counted(report.misoriented_edges, "edge", "edges") +
        " whose two faces disagree about the outside");
  if (report.non_manifold_vertices)
    add("split " + counted(report.non_manifold_vertices, "vertex", "vertices") +
        " where surfaces only touch");
  if (report.flipped_components)
    add("turned " + counted(report.flipped_components, "closed part", "closed parts") + " outward");
  std::string ignored;
  for (const std::string& what : entry.ignored) ignored += (ignored.empty() ? "" : ", ") + what;
  if (!ignored.empty()) add("ignored its " + ignored);
  return text;
}

}  // namespace penumbra::detail
