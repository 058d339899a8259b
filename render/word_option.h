// Options whose words stand for the values of an enumeration.
#pragma once

#include <string>

#include "penumbra/render/method_option.h"
#include "render/support/named_value.h"

namespace penumbra {

/// `usual` is one of the values that `names` has words for.
template <class Value>
OptionSchema word_option(const char* name, std::span<const NamedValue<Value>> names, Value usual,
                         const char* help) {
  return {.name = name,
          .domain = WordChoice{words_of(names)},
          .usual = std::string(name_in(names, usual)),
          .unit = {},
          .help = help};
}

}  // namespace penumbra
