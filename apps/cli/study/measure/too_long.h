// study, step 2: settings that are not drawn, since a cheaper one of the same method took too long.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/cli/study/settings.h"

namespace penumbra::apps {

/// Of one case. Settings are to be asked in the order of settings_of, in which cheap ones come first.
class TooLong {
 public:
  /// `limit_ms`: of a frame; 0: nothing takes too long.
  explicit TooLong(double limit_ms) : limit_ms_(limit_ms) {}

  void saw(const Setting& setting, double frame_ms);
  /// Why this setting is left out: one of the same method took too long, none of whose numbers (counts and
  /// sizes) is larger and whose other options are the same. Nothing where there is none.
  std::optional<std::string> why_not(const Setting& setting) const;

 private:
  struct Seen {
    Setting setting;
    double frame_ms;
  };
  double limit_ms_;
  std::vector<Seen> long_;
};

}  // namespace penumbra::apps
