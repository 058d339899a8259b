// Planner, step measure: what a few hundred receivers see of a light, by rays and by a sample of edges and faces.
//
// No hierarchy is made for it: of all edges and faces of the casters one to four thousand are looked at, evenly chosen, and
// numbers are scaled up. So it costs hardly more for ten million faces than for a thousand.
#pragma once

#include <functional>
#include <span>

#include "penumbra/render/plan/plan.h"
#include "penumbra/render/receivers/receivers.h"
#include "penumbra/render/scene/scene.h"
#include "render/rays/ray_scene.h"

namespace penumbra::detail {

/// `circle`: the light, or the smallest disk around it. `is_dark` tells of a receiver that it sees none of the light. Only
/// casters that may reach count. Deterministic.
SampledFacts sample_light(const Scene& objects, const RayScene& rays, const CircularLight& circle,
                          const LightShape& light, const Receivers& receivers,
                          std::span<const CasterFacts> casters,
                          const std::function<bool(std::uint32_t)>& is_dark);

}  // namespace penumbra::detail
