// study, step 1: the settings of a method that are worth comparing, from the registry alone.
//
// Where there are few options all combinations are tried; else each option is varied alone, all others at
// their defaults. A method that is registered has its rows; nothing here names one.
#pragma once

#include <string>
#include <vector>

#include "penumbra/render/method.h"

namespace penumbra::apps {

struct Setting {
  std::string method;
  /// All of the method's options.
  OptionValues options{};
  /// What differs from the defaults: an option, "draft" (all options have their cheap values), "several";
  /// empty: nothing.
  std::string varied{};

  /// "dbuffer, dbuffer-size 256": the method and what differs from the defaults; of what is not registered
  /// all options.
  std::string label() const;
};

/// Values of an option from the cheapest on: OptionSchema::steps where there are any; else every word or
/// choice, and for numbers the default times powers of 4, from 1/256 to 16, as far as the option allows, and
/// 0 where it is allowed.
std::vector<OptionValue> steps_of(const OptionSchema& option);

/// The defaults, the draft values together, and all combinations of all options' steps where these are at
/// most 16, but for those with a number above its default; else each option's steps alone. No setting occurs
/// twice. `quick`: at most 8; of the first option the three cheapest steps and the default, of others only
/// words, and those only in combination.
std::vector<Setting> settings_of(const MethodInfo& method, bool quick);

/// Whether the method takes lights of this kind.
bool takes(const MethodInfo& method, const LightShape& light);

}  // namespace penumbra::apps
