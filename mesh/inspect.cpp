#include "penumbra/mesh/inspect.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <vector>

#include "mesh/vectors.h"

namespace penumbra {
namespace {

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

/// Enough digits for a millionth of the largest side, wherever the box lies.
std::string box(const Bounds& bounds) {
  const double side = detail::largest_component(bounds.high - bounds.low);
  const double farthest =
      std::max(detail::largest_component(bounds.low), detail::largest_component(bounds.high));
  const double shift = side > 0.0 ? std::ceil(std::log10(farthest / side)) : 0.0;
  const int digits = std::clamp(6 + static_cast<int>(std::clamp(shift, 0.0, 11.0)), 6, 17);
  const auto point = [digits](const Vec3& p) {
    char text[128];
    std::snprintf(text, sizeof text, "(%.*g, %.*g, %.*g)", digits, p.x, digits, p.y, digits, p.z);
    return std::string(text);
  };
  return point(bounds.low) + " to " + point(bounds.high);
}

std::string polygon_line(const PolygonReport& report) {
  if (report.divided == 0) return {};
  std::string line = "polygons      " + std::to_string(report.divided) + " divided into triangles, " +
                     std::to_string(report.concave) + " of them not convex";
  if (report.crossing > 0)
    line += "; " + std::to_string(report.crossing) + " that cross themselves, from their first corner";
  return line + "\n";
}

std::string material_line(const MeshFindings& f) {
  if (f.materials == 0) return {};
  return "materials     " + std::to_string(f.materials) + ", " + std::to_string(f.colored_materials) +
         " with a diffuse color\n";
}

std::string ignored_line(const std::vector<std::string>& ignored) {
  std::string line;
  for (const std::string& what : ignored) line.append(line.empty() ? "ignored       " : ", ").append(what);
  return line.empty() ? line : line + "\n";
}

/// "  12 duplicate faces kept (first: 5, 9, 40)"; nothing where the list is empty.
std::string list_line(const std::vector<std::uint32_t>& ids, const char* what) {
  constexpr std::size_t kShown = 5;
  if (ids.empty()) {
    return {};
  }
  std::string line = "  ";
  line.append(std::to_string(ids.size())).append(" ").append(what).append(" (input triangles ");
  for (std::size_t i = 0; i < std::min(ids.size(), kShown); ++i) {
    line.append(i == 0 ? "" : ", ").append(std::to_string(ids[i]));
  }
  return line + (ids.size() > kShown ? ", ...)\n" : ")\n");
}

std::string count_line(std::size_t count, const char* what) {
  if (count == 0) {
    return {};
  }
  std::string line = "  ";
  return line.append(std::to_string(count)).append(" ").append(what).append("\n");
}

std::string findings_of_build(const BuildReport& report, const PolygonReport& polygons) {
  std::string text =
      count_line(polygons.skipped, "polygons with fewer than three corners left out") +
      list_line(report.degenerate, "degenerate faces left out") +
      list_line(report.zero_area, "faces without area kept") +
      list_line(report.duplicates, "faces that repeat another kept") +
      count_line(report.joined_edges, "edges with more than two faces, which were joined in pairs") +
      count_line(report.non_manifold_edges - report.joined_edges, "edges with more than two faces, cut") +
      count_line(report.misoriented_edges, "edges between faces of opposite orientation, cut") +
      count_line(report.non_manifold_vertices, "vertices between separate fans of faces, split") +
      count_line(report.split_vertices, "vertices added by cutting and splitting") +
      count_line(report.welded_vertices, "vertices welded to another at the same position") +
      count_line(report.unused_vertices, "vertices that no face uses, left out") +
      count_line(report.flipped_components, "inside-out components turned outward");
  return text.empty() ? "findings      none\n" : "findings\n" + text;
}

}  // namespace

MeshFindings inspect(const TriangleMesh& mesh) {
  MeshFindings findings;
  findings.vertices = mesh.positions().size();
  findings.edges = mesh.edges().size();
  findings.faces = mesh.triangles().size();
  findings.components = mesh.components().size();
  for (const Component& component : mesh.components()) {
    findings.closed_components += component.closed;
    findings.signed_volume += component.closed ? component.signed_volume : 0.0;
  }
  for (const Edge& edge : mesh.edges()) {
    // One fan at each vertex: a boundary vertex begins one boundary edge and ends one, so there are as many
    // of each.
    findings.boundary_edges += edge.is_boundary();
  }
  findings.boundary_vertices = findings.boundary_edges;
  findings.build = mesh.report();
  findings.closed = mesh.is_closed();
  findings.bounds = bounds_of(mesh.positions());
  for (const auto& [a, b, c] : mesh.triangles()) {
    const Vec3 &p = mesh.positions()[a], &q = mesh.positions()[b], &r = mesh.positions()[c];
    findings.surface_area += 0.5 * glm::length(glm::cross(q - p, r - p));
  }
  return findings;
}

MeshFindings inspect(const LoadedMesh& loaded) {
  MeshFindings findings = inspect(loaded.mesh);
  findings.polygons = loaded.polygons;
  findings.has_normals = loaded.has_normals;
  findings.materials = loaded.materials.size();
  findings.colored_materials = static_cast<std::size_t>(
      std::ranges::count_if(loaded.materials, [](const Material& m) { return m.color.has_value(); }));
  findings.ignored = loaded.ignored;
  return findings;
}

std::string to_text(const MeshFindings& f) {
  std::string text = "faces         " + std::to_string(f.faces) + ", " + std::to_string(f.edges) +
                     " edges, " + std::to_string(f.vertices) + " vertices\n" + polygon_line(f.polygons);
  text += "components    " + std::to_string(f.components) + ", " + std::to_string(f.closed_components) +
          " closed\n";
  text += f.closed ? "surface       closed and consistently oriented\n"
                   : "surface       open: " + std::to_string(f.boundary_edges) + " boundary edges\n";
  text += f.bounds.empty() ? "bounds        empty\n" : "bounds        " + box(f.bounds) + "\n";
  text += "area          " + number(f.surface_area) + "\n";
  text += "volume        " + number(f.signed_volume) + (f.closed ? "\n" : " (closed components only)\n");
  if (f.has_normals) text += "normals       of corners, for smooth shading\n";
  return text + material_line(f) + ignored_line(f.ignored) + findings_of_build(f.build, f.polygons);
}

}  // namespace penumbra
