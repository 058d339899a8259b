// The registration of the method backprojection.
#pragma once

#include "penumbra/render/method.h"

namespace penumbra {

/// Texels of a shadow map projected back onto the light (backprojection.h).
MethodInfo backprojection_method();

}  // namespace penumbra
