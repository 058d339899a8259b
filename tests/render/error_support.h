// Error figures of visibility, in tests.
#pragma once

#include "penumbra/render/image/error_figures.h"
#include "tests/render/render_support.h"

namespace penumbra::testing {

/// Error over true penumbra; the three spans list the same pixels.
inline ErrorFigures penumbra_error(const Values& method, const Values& r1, const Values& r2) {
  return error_figures(method, r1, r2, true_penumbra(r1, r2, first_pixels(method.size())));
}

}  // namespace penumbra::testing
