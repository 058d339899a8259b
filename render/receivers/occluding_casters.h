// Casters that hide nothing from any receiver of the image: a floor, a wall, a room seen from inside.
//
// A face hides nothing where a plane has it on one side and all of the light and every receiver on the other.
// Such casters would only cost time, and widen the D-buffer's targets: a floor that casts spreads its texels
// over all of the floor.
#pragma once

#include <vector>

#include "penumbra/render/receivers/receivers.h"
#include "penumbra/render/scene/scene.h"

namespace penumbra::detail {

/// One flag an object: casters that hide nothing from the receivers. What lies in a plane, as far as double
/// can tell, lies on either side of it (side_of_plane); so do receivers on a face in that plane. A mesh of
/// more than a hundred faces or of more than sixteen planes is not looked at, and never flagged. Cost
/// O(objects), and O(pixels) where a floor, wall or room casts.
std::vector<char> find_casters_that_cannot_occlude(const Scene& scene, const CircularLight& light,
                                                   const Receivers& receivers);

}  // namespace penumbra::detail
