// Times of named stages, for --stats and benchmarks.
#pragma once

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
  /// Ends the stage that began when the clock was made or last asked.
  void finish(std::string name) {
    const auto now = std::chrono::steady_clock::now();
    stages_.push_back({std::move(name), std::chrono::duration<double, std::milli>(now - start_).count()});
    start_ = now;
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
