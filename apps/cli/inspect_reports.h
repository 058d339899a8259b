// JSON that `inspect` prints: one object each, keys as the members are named.
#pragma once

#include <nlohmann/json.hpp>

#include "penumbra/mesh/inspect.h"
#include "penumbra/volumes/checks/repair.h"

namespace penumbra::apps {

nlohmann::ordered_json findings_report(const MeshFindings& findings);
nlohmann::ordered_json repair_report(const RepairResult& result);

}  // namespace penumbra::apps
