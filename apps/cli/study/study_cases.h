// study: its cases in order, made one at a time since scenes may be large.
#pragma once

#include <filesystem>
#include <vector>

#include "apps/cli/study/study.h"
#include "apps/cli/study/study_case.h"

namespace penumbra::apps {

class StudyCases {
 public:
  /// Refers to the options.
  explicit StudyCases(const StudyOptions& options);

  std::size_t size() const { return sources_.size(); }
  /// Throws what reading a scene does.
  StudyCase make(std::size_t number) const;
  /// How it is measured: where only cost is of interest with fewer rays, and none in double.
  const StudyOptions& options(std::size_t number) const;
  /// Empty where it is no file, or not as the file has it.
  std::filesystem::path path(std::size_t number) const;

 private:
  enum class Kind { kScene, kGrowth, kSphere };
  struct Source {
    Kind kind;
    /// Among scenes, growth_cases or sphere_case.
    std::size_t index;
  };

  const StudyOptions& options_;
  const StudyOptions growth_;
  std::vector<Source> sources_;
};

}  // namespace penumbra::apps
