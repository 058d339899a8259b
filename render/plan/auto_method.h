// The method auto: does what the plan of each light says, and no more. And a method that does what given
// plans say.
#pragma once

#include "penumbra/render/method.h"
#include "penumbra/render/plan/plan.h"

namespace penumbra {

MethodInfo auto_method();

/// The method `plan`: for the light of each plan, found by its shape, what that plan says, whatever is
/// measured. It throws UsageError for other lights. To be registered (method.h).
MethodInfo given_plan_method(std::vector<LightShape> lights, std::vector<LightPlan> plans);

/// What auto would do for this light. Cost: light_facts.h.
LightPlan plan_light(const Scene& objects, const RayScene& rays, const LightShape& light,
                     const Receivers& receivers, const PlanRequest& request);

}  // namespace penumbra
