// The arc sine in a few products, without branches, so that loops over many vectorise.
//
// For z ≤ 1/2 the rational approximation of fdlibm's e_asin.c (Sun Microsystems, 1993); beyond, asin z = π/2
// - 2 asin √((1-z)/2). Off by less than 5e-16 for |x| ≤ 1.
#pragma once

#include <cmath>
#include <numbers>

#include "render/support/vector_clones.h"

namespace penumbra::detail {

PENUMBRA_INLINE double arc_sine(double x) {
  const double z = std::abs(x);
  const bool is_far = z > 0.5;
  const double s = is_far ? std::sqrt(0.5 - 0.5 * z) : z, t = s * s;
  const double p = t * (1.66666666666666657415e-01 +
                        t * (-3.25565818622400915405e-01 +
                             t * (2.01212532134862925881e-01 +
                                  t * (-4.00555345006794114027e-02 +
                                       t * (7.91534994289814532176e-04 + t * 3.47933107596021167570e-05)))));
  const double q = 1.0 + t * (-2.40339491173441421878e+00 +
                              t * (2.02094576023350569471e+00 +
                                   t * (-6.88283971605453293030e-01 + t * 7.70381505559019352791e-02)));
  const double core = s + s * (p / q);
  return std::copysign(is_far ? 0.5 * std::numbers::pi - 2.0 * core : core, x);
}

}  // namespace penumbra::detail
