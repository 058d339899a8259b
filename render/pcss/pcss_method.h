// The registration of the method pcss.
#pragma once

#include "penumbra/render/method.h"

namespace penumbra {

/// Percentage-closer soft shadows (pcss.h).
MethodInfo pcss_method();

}  // namespace penumbra
