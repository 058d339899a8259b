// JSON that `volumes` and `classify` have in common.
#pragma once

#include <nlohmann/json.hpp>

#include "penumbra/volumes/checks/validate.h"
#include "penumbra/volumes/volumes.h"

namespace penumbra::apps {

nlohmann::json classification_report(const Classification& classes);
nlohmann::json silhouette_report(const Silhouettes& silhouettes);  ///< sizes only
nlohmann::json build_report(const BuildReport& report);
/// Counts, guarantee, signed volume (scene units³, each cell counted) and triangles per face of the caster.
nlohmann::json shadow_report(const ShadowMesh& shadow, std::size_t caster_faces);
nlohmann::json check_report(const VolumeFindings& findings);
/// Some lines for a person.
std::string check_text(std::size_t object, const std::string& name, const VolumeFindings& findings);
/// Volume enclosed by the triangles, outward positive, from tetrahedra over the first vertex.
double signed_volume(const ShadowMesh& shadow);

}  // namespace penumbra::apps
