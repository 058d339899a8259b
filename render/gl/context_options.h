// The option that every method with OpenGL has: which backend makes its context.
#pragma once

#include <string>

#include "penumbra/render/method_option.h"
#include "render/gl/context.h"

namespace penumbra::gl {

inline OptionSchema backend_option() {
  return {.name = "backend",
          .domain = WordChoice{{name_of(Backend::kOsMesa), name_of(Backend::kEgl)}},
          .usual = std::string(name_of(Backend::kOsMesa)),
          .unit = {},
          .help = "OpenGL without a window",
          .steps = std::vector<OptionValue>{}};
}

}  // namespace penumbra::gl
