// study: one case, all of whose rows share the judge, the pictures without shadows and the loaded scene.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>

#include "apps/cli/study/case_judge.h"
#include "apps/cli/study/peers/peer.h"
#include "apps/cli/study/settings.h"
#include "apps/cli/study/study.h"
#include "apps/cli/study/study_pictures.h"
#include "apps/cli/study/study_record.h"

namespace penumbra::apps {

class CaseStudy {
 public:
  /// Refers to what it is given. `scene_path` is empty for scenes that are no files; `peers` are those that can be run.
  CaseStudy(StudyRecord& record, const StudyOptions& options, std::span<const Peer> peers,
            const std::filesystem::path& scene_path, StudyCase seen);

  /// Measures the rows that the record has not. Returns how many were measured. Throws Cancelled.
  std::size_t run(const Progress& progress);

 private:
  std::string key_of(const Setting& setting) const;
  std::vector<Setting> missing_settings() const;
  std::vector<Setting> missing_of(const Peer& peer) const;
  /// Draws the case without shadows, and names it in the record.
  void begin(Renderer& renderer);
  /// The mean of FLIP against the reference's visibility in the same picture.
  double flip_of(const Renderer& renderer, const Measured& measured,
                 const std::vector<float>& reference) const;
  nlohmann::json row_of(const Setting& setting, const Measured& measured, const Renderer& renderer,
                        CaseJudge& judge);
  void measure(Renderer& renderer, CaseJudge& judge, std::span<const Setting> settings);
  /// A peer that fails has no rows, and is complained of.
  std::size_t measure_peer(Renderer& renderer, CaseJudge& judge, const Peer& peer);

  StudyRecord& record_;
  const StudyOptions& options_;
  const std::span<const Peer> peers_;
  const std::filesystem::path scene_path_;
  const StudyCase case_;
  const std::string digest_;
  nlohmann::json about_;
  LitPicture lit_;
  bool has_reference_ = false;
};

}  // namespace penumbra::apps
