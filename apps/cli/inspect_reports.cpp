#include "apps/cli/inspect_reports.h"

namespace penumbra::apps {
namespace {

using Json = nlohmann::ordered_json;

Json array_of(const Vec3& p) {
  return {p.x, p.y, p.z};
}

Json report_of(const BuildReport& report) {
  return {{"welded_vertices", report.welded_vertices},
          {"unused_vertices", report.unused_vertices},
          {"split_vertices", report.split_vertices},
          {"degenerate", report.degenerate},
          {"zero_area", report.zero_area},
          {"duplicates", report.duplicates},
          {"non_manifold_edges", report.non_manifold_edges},
          {"joined_edges", report.joined_edges},
          {"non_manifold_vertices", report.non_manifold_vertices},
          {"misoriented_edges", report.misoriented_edges},
          {"flipped_components", report.flipped_components},
          {"flipped_faces", report.flipped_faces}};
}

Json report_of(const PolygonReport& report) {
  return {{"divided", report.divided},
          {"concave", report.concave},
          {"crossing", report.crossing},
          {"skipped", report.skipped}};
}

Json report_of(const ComponentRepair& r) {
  return {{"verdict", name_of(r.verdict)},
          {"faces", r.faces.size()},
          {"first_face", r.faces.front()},
          {"dropped", r.dropped},
          {"flipped", r.flipped},
          {"stitched_edges", r.stitched_edges},
          {"boundary_edges", r.boundary_edges},
          {"non_manifold_edges", r.non_manifold_edges},
          {"not_orientable", r.not_orientable},
          {"self_intersections", r.self_intersections},
          {"all_counted", r.all_counted}};
}

}  // namespace

Json findings_report(const MeshFindings& f) {
  return {{"vertices", f.vertices},
          {"edges", f.edges},
          {"faces", f.faces},
          {"components", f.components},
          {"closed_components", f.closed_components},
          {"boundary_edges", f.boundary_edges},
          {"boundary_vertices", f.boundary_vertices},
          {"polygons", report_of(f.polygons)},
          {"has_normals", f.has_normals},
          {"materials", f.materials},
          {"colored_materials", f.colored_materials},
          {"ignored", f.ignored},
          {"build", report_of(f.build)},
          {"closed", f.closed},
          {"bounds", {{"low", array_of(f.bounds.low)}, {"high", array_of(f.bounds.high)}}},
          {"signed_volume", f.signed_volume},
          {"surface_area", f.surface_area}};
}

Json repair_report(const RepairResult& result) {
  Json components = Json::array();
  for (const ComponentRepair& r : result.components) components.push_back(report_of(r));
  return {{"faces", result.triangles.size()},
          {"welded_vertices", result.welded_vertices},
          {"degenerate", result.degenerate},
          {"components", components}};
}

}  // namespace penumbra::apps
