// Which casters' triangles the D-buffer's last surface needs.
#pragma once

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "penumbra/mesh/triangle_mesh.h"
#include "render/d_buffer/entries/receiver_grid.h"

namespace penumbra::detail {

/// One caster's place in the uploaded buffers.
struct CasterRange {
  std::uint32_t first_face;  ///< number of its first face over all objects of the scene
  std::uint32_t first_index, index_count;
  bool closed;
  Bounds bounds;      ///< in the frame of the uploaded points
  bool idle = false;  ///< hides nothing from any receiver: not drawn
};

/// Whether the light's center sees only faces that are turned to it: the caster has an inside and is not cut
/// open by the light's plane.
bool shows_only_fronts(const CasterRange& caster, const glm::mat3& axes, const glm::vec3& offset);

/// Triangles that lie before receivers which do not see the light's center; of a caster that shows only
/// fronts, those that face the center. Points are in the frame that axes and offset turn into the light's;
/// three indices a triangle. Cost O(points + triangles), on all cores.
std::vector<std::uint32_t> triangles_before_hidden(std::span<const glm::vec3> points,
                                                   std::span<const std::uint32_t> indices,
                                                   std::span<const CasterRange> casters,
                                                   const glm::mat3& axes, const glm::vec3& offset,
                                                   const ReceiverGrid& receivers);

}  // namespace penumbra::detail
