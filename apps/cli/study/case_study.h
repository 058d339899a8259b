// study: one case, all of whose rows share the judge, the pictures without shadows and the loaded scene.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <span>

#include "apps/cli/study/case_judge.h"
#include "apps/cli/study/measure/too_long.h"
#include "apps/cli/study/peers/peer.h"
#include "apps/cli/study/pictures/study_pictures.h"
#include "apps/cli/study/settings.h"
#include "apps/cli/study/study.h"
#include "apps/cli/study/study_unit.h"

namespace penumbra::apps {

class CaseStudy {
 public:
  /// Refers to what it is given. `scene_path` is empty for scenes that are no files.
  CaseStudy(const StudyOptions& options, std::span<const Peer> peers, std::filesystem::path scene_path,
            StudyCase seen);

  /// Measures these of its rows (rows_of). The first call also draws the case without shadows. A peer that
  /// fails has no rows. Cost of the first call see CaseJudge.
  UnitResult measure(std::span<const std::size_t> rows);

 private:
  void begin();
  /// The mean of FLIP against the reference's visibility in the same picture.
  double flip_of(const Measured& measured, const std::vector<float>& reference) const;
  nlohmann::json row_of(const Setting& setting, const Measured& measured, UnitResult& result);
  void measure_methods(std::span<const Setting> settings, UnitResult& result);
  void measure_peer(const Peer& peer, std::span<const Setting> settings, UnitResult& result);

  const StudyOptions& options_;
  const std::filesystem::path scene_path_;
  const StudyCase case_;
  const std::string digest_;
  const std::vector<CaseRow> rows_;
  std::unique_ptr<Renderer> renderer_;
  CaseJudge judge_;
  TooLong too_long_;
  LitPicture lit_;
  /// What is to be written besides rows.
  nlohmann::json about_;
  std::map<std::string, std::string> pictures_;
};

}  // namespace penumbra::apps
