// Planner, step measure: what a light's plan rests on.
#pragma once

#include "penumbra/render/plan/plan.h"
#include "penumbra/render/scene/scene.h"
#include "render/plan/receiver_boxes.h"
#include "render/rays/ray_scene.h"

namespace penumbra::detail {

/// `objects`: a scene's, lights left out; `rays` are theirs. `boxes` are the receivers'. Casters are taken by
/// their boxes, too. Cost: some hundred thousand operations, and for each caster a walk down the boxes of
/// receivers. On the threads of `rays`.
LightFacts measure_light(const Scene& objects, const RayScene& rays, const LightShape& light,
                         const Receivers& receivers, const ReceiverBoxes& boxes, const PlanRequest& request);

}  // namespace penumbra::detail
