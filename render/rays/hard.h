// The hard shadow: one ray to the light's center, with the horizon.
#pragma once

#include "render/rays/reference.h"

namespace penumbra {

/// 1 where the light's center is seen, else 0; conventions and cost are those of trace_reference with one
/// ray. `horizon` false: tangent planes hide nothing.
ReferenceResult trace_hard(const RayScene& rays, const LightShape& light, const Receivers& receivers,
                           std::span<const std::uint32_t> indices, bool horizon = true);

}  // namespace penumbra
