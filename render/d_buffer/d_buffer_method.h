// The D-buffer's registration.
#pragma once

#include "penumbra/render/method.h"

namespace penumbra {

/// What the light's center sees of penumbra boundaries (d_buffer.h).
MethodInfo d_buffer_method();

/// The schema of its options.
std::vector<OptionSchema> d_buffer_options();

}  // namespace penumbra
