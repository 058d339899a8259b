// Planner, step measure: whether a second pilot is worth its time, and how large.
#pragma once

#include "penumbra/render/plan/plan.h"
#include "render/plan/sample/sampled_facts.h"

namespace penumbra::detail {

/// About as many rays as the error asks for by the first pilot; none where these are hardly more than the
/// first one had, where areas are far cheaper, or where few receivers could be looked at in the time that a
/// plan may take.
PilotWish second_pilot(const LightFacts& facts, const PlanRequest& request);

}  // namespace penumbra::detail
