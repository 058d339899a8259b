// Method shadow-volumes, step culling: casters that hide the light's center from no receiver.
#pragma once

#include <vector>

#include "penumbra/render/scene/scene.h"
#include "render/light/area_light.h"
#include "render/receivers/receiver_box.h"

namespace penumbra::detail {

/// One flag an object: seen from the light's center, the box of each group of receivers lies beside the
/// caster's box or wholly nearer to the light. What reaches behind the light's plane is never flagged. Cost
/// O(objects · groups).
std::vector<char> casters_without_receivers(const Scene& scene, const AreaLight& light,
                                            const BoxedGroups& groups);

}  // namespace penumbra::detail
