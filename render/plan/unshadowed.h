// What receivers see of a light that no caster hides from any of them.
#pragma once

#include "penumbra/render/method.h"

namespace penumbra::detail {

/// V (and O, where wanted) and certificates of all receivers, by their horizons alone. On the threads of the
/// rays; no ray is traced. Cost O(receivers).
MethodResult see_unshadowed(const MethodInput& input);

/// Fills in what a result that is dark has left out. Cost O(receivers).
void fill_dark(const MethodInput& input, MethodResult& result);

}  // namespace penumbra::detail
