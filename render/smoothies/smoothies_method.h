// The registration of the method smoothies.
#pragma once

#include "penumbra/render/method.h"

namespace penumbra {

/// Hard shadows with fins at silhouettes (smoothies.h).
MethodInfo smoothies_method();

}  // namespace penumbra
