// How long the named stages of a call took, as data: for reports, `--stats` and benchmarks.
#pragma once

#include <algorithm>
#include <chrono>
#include <string>
#include <utility>
#include <vector>

namespace penumbra {

/// The wall-clock time of one stage, from its start until all of its work is finished.
struct StageTime {
  std::string name;
  double milliseconds = 0.0;
};
using StageTimes = std::vector<StageTime>;

/// Measures stages that follow one another. The first begins when the clock is made.
class StageClock {
 public:
  /// Ends the stage that began at the last call (or when the clock was made). Times of the same name add up.
  void finish(const std::string& name) {
    const auto now = std::chrono::steady_clock::now();
    const double time = std::chrono::duration<double, std::milli>(now - start_).count();
    start_ = now;
    const auto same = std::ranges::find(stages_, name, &StageTime::name);
    if (same == stages_.end())
      stages_.push_back({name, time});
    else
      same->milliseconds += time;
  }
  /// Adds a stage that was measured elsewhere. The next stage begins now.
  void add(StageTime stage) {
    stages_.push_back(std::move(stage));
    restart();
  }
  /// Begins the next stage now. The time since the last call is not recorded.
  void restart() { start_ = std::chrono::steady_clock::now(); }
  const StageTimes& stages() const { return stages_; }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  StageTimes stages_;
};

}  // namespace penumbra
