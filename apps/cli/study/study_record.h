// study, step 4: rows as they finish. DIR/rows.jsonl has one JSON object a line: "about" first, then a "case"
// before its rows, then "row" by "row". A line that an interrupt has cut is left out when the file is read
// again, and its row is measured again.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "apps/cli/study/study_unit.h"

namespace penumbra::apps {

class StudyRecord {
 public:
  /// Reads what is there, or begins the file. `about` says what measures: machine, version, commit. Throws
  /// UsageError where the file's rows were measured by something else, SystemError where it cannot be read or
  /// written.
  StudyRecord(std::filesystem::path folder, nlohmann::json about);

  bool has_row(const std::string& key) const { return keys_.contains(key); }
  /// Writes its pictures, then the case, then those of its rows that are not there by "key". Returns how many
  /// these were.
  std::size_t add(const UnitResult& result);

  const std::filesystem::path& folder() const { return folder_; }
  const nlohmann::json& about() const { return about_; }
  const std::vector<nlohmann::json>& cases() const { return cases_; }
  const std::vector<nlohmann::json>& rows() const { return rows_; }

 private:
  void read();
  /// Does nothing where it is there.
  void add_case(const nlohmann::json& seen);
  void add_row(const nlohmann::json& row);
  void take(const nlohmann::json& line);
  /// Drops what was measured of another scene of that name, or of the same before it was changed: its
  /// pictures are replaced.
  void forget_another(const nlohmann::json& seen);
  void append(const nlohmann::json& line) const;
  std::filesystem::path file() const { return folder_ / "rows.jsonl"; }

  std::filesystem::path folder_;
  nlohmann::json about_;
  std::vector<nlohmann::json> cases_, rows_;
  std::set<std::string> keys_;
};

/// DIR/study.json: all of it as one object. DIR/study.csv: one line a row.
void write_tables(const StudyRecord& record);

}  // namespace penumbra::apps
