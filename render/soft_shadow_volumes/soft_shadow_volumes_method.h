// The registration of the method soft-shadow-volumes.
#pragma once

#include "penumbra/render/method.h"

namespace penumbra {

/// Penumbra wedges of the silhouettes that the light's center sees (soft_shadow_volumes.h).
MethodInfo soft_shadow_volumes_method();

}  // namespace penumbra
