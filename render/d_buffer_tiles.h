// Which parts of the image a D-buffer's entries can matter in, so that shading skips the rest.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "render/d_buffer_geometry.h"
#include "render/d_buffer_targets.h"

namespace penumbra::detail {

/// The image's receivers in a frame that axes and offset turn into the light's; the fourth number is 0 where
/// nothing is seen.
struct ImageReceivers {
  int width, height;
  std::span<const glm::vec4> positions;
  glm::mat3 axes;
  glm::vec3 offset;
};

/// Rectangles of the image in clip coordinates, two triangles each. They cover every receiver whose texel an
/// entry's triangle may touch: by the triangles' bounds on a coarse grid over the target's window. Cost
/// O(pixels + triangles), on all cores.
std::vector<glm::vec2> tiles_with_entries(const ImageReceivers& image, const EntryGeometry& entries,
                                          const Target& target);

/// The whole image, in the same form.
std::vector<glm::vec2> whole_image();

}  // namespace penumbra::detail
