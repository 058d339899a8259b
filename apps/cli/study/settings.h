// study, step 1: the settings of a method that are worth comparing, from the registry alone.
//
// Each option is varied alone, all others at their defaults. A method that is registered has its rows; nothing here
// names one.
#pragma once

#include <string>
#include <vector>

#include "penumbra/render/method.h"

namespace penumbra::apps {

struct Setting {
  std::string method;
  /// All of the method's options.
  OptionValues options{};
  /// The option that differs from its default; "draft" where all options have their cheap values; empty: none does.
  std::string varied{};

  /// "dbuffer, dbuffer-size 256": the method and what differs from the defaults.
  std::string label() const;
};

/// Values of an option from the cheapest on: OptionSchema::steps where there are any; else every word or choice, and
/// for numbers the default times powers of 4, from 1/256 to 16, as far as the option allows, and 0 where it is allowed.
std::vector<OptionValue> steps_of(const OptionSchema& option);

/// The defaults, the draft values together, then each option's steps. No setting occurs twice. `quick`: of
/// each method the three cheapest steps of its first option alone.
std::vector<Setting> settings_of(const MethodInfo& method, bool quick);

/// Whether the method takes lights of this kind.
bool takes(const MethodInfo& method, const LightShape& light);

}  // namespace penumbra::apps
