// What penumbra volumes was asked for.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/common/options.h"
#include "apps/common/outputs.h"
#include "penumbra/volumes/extrude.h"

namespace penumbra::apps {

struct VolumeArguments {
  CommonOptions common;
  SceneInput scene;
  std::filesystem::path umbra, penumbra, sheets, report, level_file;
  /// "solid" or "cells"; empty: solids where files are written, else cells.
  std::string form;
  std::string tolerance;  ///< of solids: scene units, or with % of the casters' diagonal; empty: the usual
  double level = 0.5;
  std::string light;  ///< name or number; empty: each
  bool merge = false, check = false, hollow = false;
  int cone_segments = ExtrudeOptions{}.cone_segments;

  bool writes_volumes() const { return !umbra.empty() || !penumbra.empty() || !level_file.empty(); }
  bool only_report() const { return !writes_volumes() && sheets.empty(); }
  /// Where results go, of which one may be standard output. What --check finds goes there unless the report
  /// does.
  std::vector<std::filesystem::path> destinations() const {
    std::vector<std::filesystem::path> all = {umbra, penumbra, sheets, level_file, report};
    if (check && !is_standard(report)) all.emplace_back("-");
    return all;
  }
  bool solid() const { return form == "solid" || (form.empty() && writes_volumes()); }
};

/// What was made for one light.
struct VolumeReport {
  nlohmann::json json;
  std::string findings;  ///< of --check, for a person
  bool good = true;
};

/// "u.ply" → "u.NAME.ply"; as it is where the scene has one light or one was chosen.
std::filesystem::path file_of_light(const std::filesystem::path& path, const std::string& light);

}  // namespace penumbra::apps
