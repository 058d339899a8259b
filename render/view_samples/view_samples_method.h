// The registration of the method view-samples.
#pragma once

#include "penumbra/render/method.h"

namespace penumbra {

/// Light samples hidden by masks of half-planes (view_samples.h).
MethodInfo view_samples_method();

}  // namespace penumbra
