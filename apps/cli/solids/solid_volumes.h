// penumbra volumes --form solid: solids of a scene's casters, as files and as a report.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "penumbra/render/scene/scene.h"

namespace penumbra::apps {

struct SolidArguments {
  std::filesystem::path umbra, penumbra, level_file;
  double level = 0.5;
  std::string tolerance;  ///< scene units, or with % of the casters' diagonal; empty: the usual
  bool merge = false, check = false, verbose = false;
  int threads = 0;
};

/// Throws UsageError.
void check(const SolidArguments& arguments);

/// "u.ply" → "u.NAME.ply"; as it is where the scene has one light or one was chosen.
std::filesystem::path file_of_light(const std::filesystem::path& path, const std::string& light);

struct SolidReport {
  nlohmann::json json;
  std::string findings;  ///< of --check, for a person
  bool good = true;
};

/// Makes and writes what is asked for under one light. `name`: where the files of several lights are told apart by it.
SolidReport write_solids(const SolidArguments& arguments, const Scene& scene, const LightShape& light,
                         const std::string& name);

}  // namespace penumbra::apps
