// The registration of the method variance.
#pragma once

#include "penumbra/render/method.h"

namespace penumbra {

/// Soft shadows from means and variances of depths (variance.h).
MethodInfo variance_method();

}  // namespace penumbra
