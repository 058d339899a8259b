#include "render/scene/scene_mesh.h"

#include <cmath>
#include <utility>

#include "penumbra/mesh/error.h"

namespace penumbra::detail {
namespace {

std::string counted(std::size_t count, const char* one, const char* many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

}  // namespace

const MeshCache::Entry& MeshCache::get(const std::filesystem::path& path) {
  std::error_code error;
  std::filesystem::path key = std::filesystem::weakly_canonical(path, error);
  if (error) key = path;
  if (const auto it = entries_.find(key); it != entries_.end()) return it->second;
  PolygonSoup soup = read_polygon_soup(path);
  Entry entry{.positions = {}, .triangulation = triangulate(soup)};
  entry.positions = std::move(soup.positions);
  return entries_.emplace(key, std::move(entry)).first->second;
}

TriangleMesh place_mesh(const MeshCache::Entry& entry, const Transform& transform) {
  std::vector<Vec3> positions;
  positions.reserve(entry.positions.size());
  for (const Vec3& p : entry.positions) {
    const Vec3 world = transform.apply(p);
    if (!std::isfinite(world.x + world.y + world.z))
      throw MeshError("the transform moves a vertex beyond the range of numbers; use a smaller one");
    positions.push_back(world);
  }
  std::vector<IndexedTriangle> triangles = entry.triangulation.triangles;
  if (transform.mirrors())
    for (IndexedTriangle& t : triangles) std::swap(t[1], t[2]);
  TriangleMesh mesh = TriangleMesh::build(positions, triangles);
  if (mesh.empty()) throw MeshError("no face has three distinct corners; nothing is left of the mesh");
  return mesh;
}

std::string summary_of(const Triangulation& triangulation, const BuildReport& report) {
  std::string text;
  const auto add = [&text](const std::string& part) { text += (text.empty() ? "" : "; ") + part; };
  const std::size_t left_out = report.degenerate.size() + triangulation.report.skipped;
  if (left_out) add("left out " + counted(left_out, "face", "faces") + " without three distinct corners");
  if (triangulation.report.crossing)
    add("divided " +
        counted(triangulation.report.crossing, "polygon that crosses itself",
                "polygons that cross themselves") +
        " from the first corner");
  if (report.non_manifold_edges)
    add("split at " + counted(report.non_manifold_edges, "edge", "edges") + " with more than two faces");
  if (report.misoriented_edges)
    add("split at " + counted(report.misoriented_edges, "edge", "edges") +
        " whose two faces disagree about the outside");
  if (report.non_manifold_vertices)
    add("split " + counted(report.non_manifold_vertices, "vertex", "vertices") +
        " where surfaces only touch");
  if (report.flipped_components)
    add("turned " + counted(report.flipped_components, "closed part", "closed parts") + " outward");
  return text;
}

}  // namespace penumbra::detail
