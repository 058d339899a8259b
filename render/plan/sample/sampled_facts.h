// Planner, step measure: what a few hundred receivers see of a light, by rays and by a sample of edges and
// faces.
//
// No hierarchy is made for it: of all edges and faces of the casters one to two thousand are looked at,
// evenly chosen, and numbers are scaled up. So it costs hardly more for ten million faces than for a
// thousand.
#pragma once

#include <functional>
#include <span>

#include "penumbra/render/plan/plan.h"
#include "penumbra/render/receivers/receivers.h"
#include "penumbra/render/scene/scene.h"
#include "render/rays/ray_scene.h"

namespace penumbra::detail {

/// A second pilot: rays of each estimate, and receivers at most; 0: none.
struct PilotWish {
  int samples = 1;
  std::size_t receivers = 0;
};

/// `circle`: the light, or the smallest disk around it. `is_dark` tells of a receiver that it sees none of
/// the light. Only casters that may reach count. `wish`: asked once, with the facts without a second pilot.
/// Deterministic.
SampledFacts sample_light(const Scene& objects, const RayScene& rays, const CircularLight& circle,
                          const LightShape& light, const Receivers& receivers,
                          std::span<const CasterFacts> casters,
                          const std::function<bool(std::uint32_t)>& is_dark,
                          const std::function<PilotWish(const SampledFacts&)>& wish);

}  // namespace penumbra::detail
