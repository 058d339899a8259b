// Settings at which a test of every method takes little time.
#pragma once

#include "penumbra/render/renderer.h"

namespace penumbra::testing {

/// The drafts of a method's options; those without a draft are left out.
inline OptionValues drafts_of(const std::string& method) {
  register_drawing_methods();
  OptionValues out;
  for (const OptionSchema& option : method_named(method).options)
    if (option.draft) out[option.name] = *option.draft;
  return out;
}

}  // namespace penumbra::testing
