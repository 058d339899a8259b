// Which triangles of casters are drawn into the D-buffer's last surface (step 5).
#pragma once

#include <cstdint>
#include <vector>

#include "render/d_buffer/entries/receiver_grid.h"
#include "render/d_buffer/view/casters.h"

namespace penumbra::detail {

/// The triangles that may lie before a receiver that does not see the light's center; only these are read. Of
/// a caster that shows only fronts those that face the center. Out: indices as in `casters`, three a
/// triangle. `points`: as from drawn_points. Casters that cannot occlude are left out. Cost O(triangles), on all cores.
std::vector<std::uint32_t> triangles_before_hidden(const CasterTriangles& casters,
                                                   const std::vector<glm::vec4>& points,
                                                   const ReceiverGrid& receivers);

}  // namespace penumbra::detail
