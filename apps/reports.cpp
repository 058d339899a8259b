#include "apps/reports.h"

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

}  // namespace penumbra::apps
