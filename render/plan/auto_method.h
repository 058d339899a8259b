// The method auto: does what the plan of each light says, and no more.
#pragma once

#include "penumbra/render/method.h"
#include "penumbra/render/plan/plan.h"

namespace penumbra {

MethodInfo auto_method();

/// What auto would do for this light. Cost: light_facts.h.
LightPlan plan_light(const Scene& objects, const RayScene& rays, const LightShape& light,
                     const Receivers& receivers, const PlanRequest& request);

}  // namespace penumbra
