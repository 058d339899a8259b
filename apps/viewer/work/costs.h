// What pictures cost, over the last seconds.
#pragma once

#include <chrono>
#include <deque>
#include <vector>

#include "apps/viewer/work/render_worker.h"

namespace penumbra::viewer {

class Costs {
 public:
  /// To be told of each new frame once.
  void add(const Frame& frame);
  /// Pictures that arrived in the last second.
  int per_second() const;
  /// Milliseconds of the last pictures, oldest first.
  const std::vector<float>& history() const { return history_; }

 private:
  using Clock = std::chrono::steady_clock;
  std::deque<Clock::time_point> arrivals_;
  std::vector<float> history_;
};

/// Bytes of this process that are in memory; 0 where the system does not tell.
std::size_t resident_bytes();

}  // namespace penumbra::viewer
