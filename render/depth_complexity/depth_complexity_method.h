// The registration of the method depth-complexity.
#pragma once

#include "penumbra/render/method.h"

namespace penumbra {

/// Light samples that silhouettes toggle (depth_complexity.h).
MethodInfo depth_complexity_method();

}  // namespace penumbra
