// Which triangles of casters are drawn into the D-buffer's last surface (step 5).
#pragma once

#include <cstdint>
#include <vector>

#include "render/d_buffer/entries/receiver_grid.h"
#include "render/d_buffer/view/casters.h"
#include "render/d_buffer/view/view.h"

namespace penumbra::detail {

/// Triangles to draw.
struct ReadTriangles {
  /// Three a triangle, into the points, and beyond them into `more`.
  std::vector<std::uint32_t> indices;
  std::vector<glm::vec4> more;
};

/// The triangles that may lie before a receiver that does not see the light's center; only these are read. Of
/// a caster that shows only fronts those that face the center. Those that reach far out of the window are cut
/// (window_clip.h). `points`: as from drawn_points. Casters that cannot occlude are left out. Cost
/// O(triangles), on all cores.
ReadTriangles triangles_before_hidden(const CasterTriangles& casters, const DBufferView& view,
                                      const std::vector<glm::vec4>& points, const ReceiverGrid& receivers);

}  // namespace penumbra::detail
