#include "apps/viewer/work/costs.h"

#include <unistd.h>

#include <fstream>

namespace penumbra::viewer {

void Costs::add(const Frame& frame) {
  constexpr std::size_t kKept = 120;
  const Clock::time_point now = Clock::now();
  arrivals_.push_back(now);
  while (now - arrivals_.front() > std::chrono::seconds(1)) arrivals_.pop_front();
  history_.push_back(static_cast<float>(frame.milliseconds));
  if (history_.size() > kKept) history_.erase(history_.begin());
}

int Costs::per_second() const {
  const Clock::time_point now = Clock::now();
  int count = 0;
  for (const Clock::time_point each : arrivals_) count += now - each <= std::chrono::seconds(1);
  return count;
}

std::size_t resident_bytes() {
  std::ifstream in("/proc/self/statm");
  std::size_t whole = 0, resident = 0;
  return in >> whole >> resident ? resident * static_cast<std::size_t>(sysconf(_SC_PAGESIZE)) : 0;
}

}  // namespace penumbra::viewer
