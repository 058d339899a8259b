// Planner, step measure: how wide a light's penumbra can be on a picture's pixels.
#pragma once

#include <span>

#include "penumbra/render/plan/plan.h"
#include "penumbra/render/scene/scene.h"
#include "render/plan/light_sides.h"
#include "render/plan/receiver_boxes.h"

namespace penumbra::detail {

/// The widest penumbra, in distances between neighboring pixels' receivers; a bound where surfaces are flat.
/// Infinite where receivers are no pixels or have no normals, where a caster touches the light's plane, and
/// where some receiver's horizon cuts the light: what lies between is then no penumbra of a caster.
///
/// A point e of a caster at the depth z_e before a light of radius r throws a shadow from each point of the
/// light; at the depth z these lie within r (z - z_e) / z_e of the one from the center (of a distant light of
/// tangent t within t (z - z_e)). On a surface that is inclined by the angle θ to the light's way it is 1 /
/// cos θ times as wide. Cost O(groups · casters), and O(receivers) of what casters reach; on the calling
/// arena's threads.
double widest_penumbra(const Scene& objects, const CircularLight& light, const LightSides& sides,
                       const Receivers& receivers, const ReceiverBoxes& boxes,
                       std::span<const CasterFacts> casters);

}  // namespace penumbra::detail
