// The registration of the method penumbra-maps.
#pragma once

#include "penumbra/render/method.h"

namespace penumbra {

/// Hard shadows with a penumbra outside (penumbra_maps.h).
MethodInfo penumbra_maps_method();

}  // namespace penumbra
