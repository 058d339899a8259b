#include "apps/viewer/work/fresh_name.h"

#include <algorithm>
#include <cstdio>

namespace penumbra::viewer {

std::string fresh_stem(const std::filesystem::path& folder, const State& state,
                       std::initializer_list<std::string> ends) {
  for (int number = 1;; ++number) {
    char digits[16];
    std::snprintf(digits, sizeof digits, "-%03d", number);
    const std::string stem = state.path.stem().string() + digits;
    if (std::ranges::none_of(
            ends, [&](const std::string& end) { return std::filesystem::exists(folder / (stem + end)); }))
      return stem;
  }
}

}  // namespace penumbra::viewer
