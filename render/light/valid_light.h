// Lights made by hand: what no file reader has looked at.
#pragma once

#include "penumbra/render/light/light.h"

namespace penumbra {

/// Throws UsageError for numbers that are not finite, a normal of length 0, a radius below 0, half extents
/// that are not above 0, a tangent that is 0 or parallel to the normal.
void require_valid(const LightShape& light);

}  // namespace penumbra
