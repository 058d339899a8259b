// study: what is measured at once, and what comes of it. Both can be sent as bytes (../ranks/).
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/cli/study/peers/peer.h"
#include "apps/cli/study/settings.h"
#include "apps/cli/study/study.h"
#include "apps/cli/study/study_case.h"

namespace penumbra::apps {

/// A row that a case can have.
struct CaseRow {
  Setting setting;
  /// Who measures it; null: a method of ours.
  const Peer* peer = nullptr;
};

/// All rows that a case can have, in order: the same wherever the options are the same.
std::vector<CaseRow> rows_of(const StudyCase& seen, const StudyOptions& options, std::span<const Peer> peers);

/// Names the row in the record: case, setting, and the case's digest.
std::string key_of(const StudyCase& seen, const std::string& digest, const Setting& setting);

/// Rows of one case that are timed in turn, or that one peer measures in one run.
struct StudyUnit {
  std::size_t case_number = 0;
  /// Among rows_of.
  std::vector<std::size_t> rows;
};

struct UnitResult {
  /// The case, to be named in the record before its rows.
  nlohmann::json seen;
  std::vector<nlohmann::json> rows;
  /// Files of DIR/pictures: bytes by name.
  std::map<std::string, std::string> pictures;
  /// Why rows are missing; empty: none are.
  std::string complaint{};
};

std::string to_bytes(const StudyUnit& unit);
std::string to_bytes(const UnitResult& result);
StudyUnit unit_of(const std::string& bytes);
UnitResult result_of(const std::string& bytes);

}  // namespace penumbra::apps
