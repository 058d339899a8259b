#include "apps/cli/study/measure/too_long.h"

#include <algorithm>
#include <cstdio>

namespace penumbra::apps {
namespace {

bool is_no_larger(const OptionValue& value, const OptionValue& than) {
  const auto* a = std::get_if<std::uint64_t>(&value);
  const auto* b = std::get_if<std::uint64_t>(&than);
  return a && b ? *a <= *b : value == than;
}

bool is_no_dearer(const Setting& setting, const Setting& than) {
  return setting.method == than.method && std::ranges::all_of(setting.options, [&](const auto& option) {
           const auto other = than.options.find(option.first);
           return other != than.options.end() && is_no_larger(option.second, other->second);
         });
}

}  // namespace

void TooLong::saw(const Setting& setting, double frame_ms) {
  if (limit_ms_ > 0.0 && frame_ms > limit_ms_) long_.push_back({setting, frame_ms});
}

std::optional<std::string> TooLong::why_not(const Setting& setting) const {
  const auto found =
      std::ranges::find_if(long_, [&](const Seen& seen) { return is_no_dearer(seen.setting, setting); });
  if (found == long_.end()) return std::nullopt;
  char seconds[32];
  std::snprintf(seconds, sizeof seconds, "%.3g", 1e-3 * found->frame_ms);
  return "left out: a frame by " + found->setting.label() + " took " + seconds + " s";
}

}  // namespace penumbra::apps
