// Which parts of the image a D-buffer's entries can matter in, so that shading skips the rest.
#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "render/d_buffer/entries/geometry.h"
#include "render/d_buffer/entries/targets.h"

namespace penumbra::detail {

/// Rectangles of the image in clip coordinates, two triangles each. They cover every receiver that may read
/// an entry: of the kind that it reads, in a texel that the entry's triangle may touch (by the triangles'
/// bounds on a coarse grid). `receivers` are not everywhere. Cost O(pixels + triangles), on all cores.
std::vector<glm::vec2> tiles_with_entries(const ImageReceivers& image, const ReceiverGrid& receivers,
                                          const EntryGeometry& entries, const Target& target);

/// The whole image, in the same form.
std::vector<glm::vec2> whole_image();

}  // namespace penumbra::detail
