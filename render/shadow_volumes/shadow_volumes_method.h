// The registration of the method shadow-volumes.
#pragma once

#include "penumbra/render/method.h"

namespace penumbra {

/// Hard shadows by counting shadow volumes (shadow_volumes.h).
MethodInfo shadow_volumes_method();

}  // namespace penumbra
