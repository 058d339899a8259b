// Accurate rung: rays from a tile's receivers to points of the disk, in packets.
#pragma once

#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "render/silhouette_frame.h"
#include "render/surface_buffer.h"

namespace penumbra::detail {

struct RayTask {
  std::uint32_t pixel;
  glm::dvec2 aim;            ///< on the unit disk
  bool free = false;         ///< the answer
  std::size_t receiver = 0;  ///< of the tile, for whoever asks
};

/// The offset of receivers in scene units: that of ray origins (kRayOffset).
double receiver_offset(const RayFrame& frame);

/// Traces from the surface points, moved by the offset, to the disk.
void trace_tasks(const RayScene& rays, const SurfaceBuffer& surface, const UnitLight& light,
                 std::span<RayTask> tasks);

}  // namespace penumbra::detail
