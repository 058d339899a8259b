// Times of named stages, for --stats and benchmarks.
#pragma once

#include <algorithm>
#include <chrono>
#include <string>
#include <utility>
#include <vector>

namespace penumbra {

/// Milliseconds of one stage, everything finished, steady clock.
struct StageTime {
  std::string name;
  double milliseconds;
};

class StageClock {
 public:
  /// Ends the stage that began when the clock was made or last asked. Times of one name add up.
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
  /// A stage that was timed elsewhere; the clock goes on from now.
  void add(StageTime stage) {
    stages_.push_back(std::move(stage));
    restart();
  }
  /// Starts afresh without recording what went before.
  void restart() { start_ = std::chrono::steady_clock::now(); }
  const std::vector<StageTime>& stages() const { return stages_; }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::vector<StageTime> stages_;
};

}  // namespace penumbra
