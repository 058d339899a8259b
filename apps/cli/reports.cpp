#include "apps/cli/reports.h"

#include <glm/geometric.hpp>

namespace penumbra::apps {

nlohmann::json classification_report(const Classification& classes) {
  return {{"faces", classes.faces.size()},
          {"classes",
           {{"all_front", classes.all_front}, {"mixed", classes.mixed}, {"none_front", classes.none_front}}},
          {"tiers",
           {{"filter", classes.tally.filter},
            {"interval", classes.tally.interval},
            {"exact", classes.tally.exact}}}};
}

nlohmann::json silhouette_report(const Silhouettes& silhouettes) {
  return {{"umbra", silhouettes.umbra.size()},
          {"penumbra", silhouettes.penumbra.size()},
          {"band", silhouettes.band.size()}};
}

nlohmann::json build_report(const BuildReport& report) {
  return {{"welded_vertices", report.welded_vertices},
          {"unused_vertices", report.unused_vertices},
          {"split_vertices", report.split_vertices},
          {"degenerate", report.degenerate.size()},
          {"zero_area", report.zero_area.size()},
          {"duplicates", report.duplicates.size()},
          {"non_manifold_edges", report.non_manifold_edges},
          {"non_manifold_vertices", report.non_manifold_vertices},
          {"misoriented_edges", report.misoriented_edges},
          {"flipped_components", report.flipped_components},
          {"flipped_faces", report.flipped_faces}};
}

double signed_volume(const ShadowMesh& shadow) {
  if (shadow.positions.empty()) return 0.0;
  const Vec3 apex = shadow.positions.front();
  double sum = 0.0;
  for (const IndexedTriangle& t : shadow.triangles) {
    const Vec3 a = shadow.positions[t[0]] - apex;
    const Vec3 b = shadow.positions[t[1]] - apex;
    const Vec3 c = shadow.positions[t[2]] - apex;
    sum += glm::dot(a, glm::cross(b, c));
  }
  return sum / 6.0;
}

nlohmann::json shadow_report(const ShadowMesh& shadow, std::size_t caster_faces) {
  const auto faces = static_cast<double>(caster_faces);
  nlohmann::json report = {{"triangles", shadow.triangles.size()},
                           {"vertices", shadow.positions.size()},
                           {"triangles_per_face", static_cast<double>(shadow.triangles.size()) / faces},
                           {"guarantee", name_of(shadow.guarantee)}};
  if (shadow.guarantee == Guarantee::kNone) return report;
  report["cells"] = shadow.cells;
  report["signed_volume"] = signed_volume(shadow);
  return report;
}

namespace {

nlohmann::json surface_report(const SurfaceFindings& f) {
  return {{"triangles", f.triangles},
          {"closed", f.closed()},
          {"unmatched_half_edges", f.unmatched_half_edges},
          {"degenerate", f.degenerate},
          {"self_intersections", f.self_intersections},
          {"all_listed", f.all_listed},
          {"pieces", f.pieces},
          {"crossed_pieces", f.crossed_pieces},
          {"solid_pieces", f.solid_pieces},
          {"bounds_a_volume", f.bounds_a_volume}};
}

nlohmann::json containment_report(const ContainmentFindings& f) {
  nlohmann::json report = {{"points", f.points}, {"outside", f.outside}};
  if (f.example) report["example"] = {f.example->x, f.example->y, f.example->z};
  return report;
}

std::string surface_text(const char* name, const SurfaceFindings& f) {
  if (f.triangles == 0) return std::string("  ") + name + "empty\n";
  std::string text = std::string("  ") + name + (f.closed() ? "closed and oriented" : "NOT CLOSED") + "; " +
                     std::to_string(f.solid_pieces) + " of " + std::to_string(f.pieces) +
                     " pieces bound a volume";
  if (f.crossed_pieces > 0) text += ", " + std::to_string(f.crossed_pieces) + " cross themselves";
  if (!f.self_intersections.empty())
    text += std::string("; ") + (f.all_listed ? "" : "more than ") +
            std::to_string(f.self_intersections.size()) + " pairs of triangles intersect";
  return text + "\n";
}

std::string containment_text(const char* name, const ContainmentFindings& f) {
  return std::string("  ") + name + std::to_string(f.points) + " points, " + std::to_string(f.outside) +
         " outside\n";
}

}  // namespace

nlohmann::json check_report(const VolumeFindings& f) {
  return {{"good", f.good()},
          {"umbra", surface_report(f.umbra)},
          {"penumbra", surface_report(f.penumbra)},
          {"umbra_in_hard", containment_report(f.umbra_in_hard)},
          {"hard_in_penumbra", containment_report(f.hard_in_penumbra)},
          {"umbra_in_penumbra", containment_report(f.umbra_in_penumbra)}};
}

std::string check_text(std::size_t object, const std::string& name, const VolumeFindings& f) {
  return "object " + std::to_string(object) + " " + name + ": " + (f.good() ? "good" : "NOT GOOD") + "\n" +
         surface_text("umbra               ", f.umbra) + surface_text("penumbra            ", f.penumbra) +
         containment_text("umbra in hard       ", f.umbra_in_hard) +
         containment_text("hard in penumbra    ", f.hard_in_penumbra) +
         containment_text("umbra in penumbra   ", f.umbra_in_penumbra);
}

}  // namespace penumbra::apps
