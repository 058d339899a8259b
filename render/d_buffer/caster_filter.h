// Which triangles of casters are drawn into the D-buffer's last surface (step 5).
#pragma once

#include <cstdint>
#include <vector>

#include "render/d_buffer/casters.h"
#include "render/d_buffer/entries/receiver_grid.h"
#include "render/d_buffer/view.h"

namespace penumbra::detail {

/// Whether the light's center sees only faces of the caster that are turned to it: the caster is closed, and
/// the light's plane does not cut it open. Cost O(1).
bool shows_only_fronts(const CasterRange& caster, const DBufferView& view);

/// The triangles that may lie before a receiver that does not see the light's center; only these are read. Of
/// a caster that shows only fronts those that face the center. Out: indices as in `casters`, three a
/// triangle. Casters that cannot occlude are left out. Cost O(points + triangles), on all cores.
std::vector<std::uint32_t> triangles_before_hidden(const CasterTriangles& casters, const DBufferView& view,
                                                   const ReceiverGrid& receivers);

}  // namespace penumbra::detail
