// penumbra study: what accuracy costs in time. Every registered method with the settings worth having
// (settings.h) is timed (measure.h) and judged (case_judge.h) on every scene. Rows are kept as they finish
// (study_record.h), and shown on one page (study_page.h).
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/cli/study/case_judge.h"
#include "penumbra/mesh/progress.h"

namespace penumbra::apps {

class Ranks;

struct StudyOptions {
  std::vector<std::filesystem::path> scenes;
  std::filesystem::path output;
  /// Also names of peers. Empty: every registered method, and all peers.
  std::vector<std::string> methods{};
  StudyView view{};
  /// Timed frames a row.
  int rounds = 3;
  /// Settings are left out that are dearer than one whose frame took longer than so many seconds; 0: none is.
  double longest_frame_s = 20.0;
  JudgeOptions judge{};
  /// Fewer settings (settings_of).
  bool quick = false;
  /// Whether the memory of each method's defaults is measured, by a program of its own.
  bool memory = true;
  /// Also how cost grows: of the first scene with its light and with the picture's size, and of a sphere with
  /// its faces.
  bool growth = false;
  /// Also what people use instead (peers/). Those that are methods are to be registered before.
  bool peers = false;
  /// The folder of npm's package three, for the peer that needs it; may be empty.
  std::filesystem::path three{};
  /// What the page says of the program's sources.
  std::string commit{};
};

/// Measures the rows that DIR does not have and writes rows.jsonl, study.json, study.csv, pictures/ and
/// index.html there. Returns how many rows were measured. Of several ranks (null: this process is alone) only
/// rank 0 writes; the others measure with it and return nothing. Throws UsageError where DIR's rows were
/// measured by something else.
std::optional<std::size_t> run_study(const StudyOptions& options, Ranks* ranks,
                                     const Progress& progress = {});

}  // namespace penumbra::apps
