// What every method answers for a light that is a point.
#pragma once

#include "penumbra/render/method.h"

namespace penumbra {

/// A point has no penumbra: one ray a receiver is exact.
MethodResult hard_shadow(const MethodInput& input);

}  // namespace penumbra
