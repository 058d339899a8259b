// study, step 3: how wrong a setting is. One judge serves all settings of a case, so that references are
// traced once.
#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <vector>

#include "apps/cli/compare/comparison.h"
#include "apps/cli/study/measure/measure.h"
#include "apps/cli/study/study_case.h"

namespace penumbra::apps {

struct JudgeOptions {
  /// Rays a pixel of each of the two references.
  int samples = 4'096;
  /// The worst pixels are sampled again, as `penumbra compare` does.
  bool resample = true;
  /// Pixels at which rays in double look as well, chosen by chance; 0: none.
  std::size_t double_pixels = 2'000;
  /// Rays a pixel of each of the two sets in double.
  int double_samples = 1'024;
  int threads = 0;
};

struct Verdict {
  /// By Embree's rays, and by rays in double at some pixels (penumbra compare --judge double).
  Comparison by_rays, by_double;
  /// Certificates of lit and umbra at all pixels, and those that 256 of Embree's rays contradict.
  std::size_t certified = 0, contradicted = 0;
};

class CaseJudge {
 public:
  /// Refers to the case.
  CaseJudge(const StudyCase& seen, const JudgeOptions& options);
  ~CaseJudge();

  /// Cost of the first call O(pixels · samples · log faces), of others far less. Throws what SceneComparison
  /// does.
  Verdict judge(const Measured& measured);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// The figures of a row: "penumbra", "all", "double", "certificates".
nlohmann::json to_json(const Verdict& verdict);

}  // namespace penumbra::apps
