// D-buffer step 6: in which parts of the image entries can matter. Shading skips the rest.
#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "render/d_buffer/entries/geometry.h"
#include "render/d_buffer/view/targets.h"

namespace penumbra::detail {

/// Rectangles of the image in clip coordinates, two triangles each. They cover every receiver that may read
/// an entry: one of the kind that it reads, in a texel that the entry's triangle may touch, by the bounds of
/// triangles on a coarse grid. Precondition: `receivers` are not everywhere. Cost O(pixels + triangles), on
/// all cores.
std::vector<glm::vec2> tiles_with_entries(const ImageReceivers& image, const ReceiverGrid& receivers,
                                          const EntryGeometry& entries, const Target& target);

/// The whole image, in the same form.
std::vector<glm::vec2> whole_image();

}  // namespace penumbra::detail
