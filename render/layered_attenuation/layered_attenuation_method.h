// The registration of the method layered-attenuation.
#pragma once

#include "penumbra/render/method.h"

namespace penumbra {

/// Many shadow maps as layers of one view (layered_attenuation.h).
MethodInfo layered_attenuation_method();

}  // namespace penumbra
