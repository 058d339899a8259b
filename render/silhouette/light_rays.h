// Silhouette method: rays from a tile's receivers to points of the disk, in packets.
#pragma once

#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "penumbra/render/receivers/receivers.h"
#include "render/rays/ray_scene.h"
#include "render/silhouette/collect/light_band.h"

namespace penumbra::detail {

struct RayTask {
  std::uint32_t index;       ///< of the receiver at which it starts
  glm::dvec2 aim;            ///< on the unit disk
  bool free = false;         ///< the answer
  std::size_t receiver = 0;  ///< of the tile, for whoever asks
};

/// Traces from the receivers to the disk (rays/ray_packets.h), and ends `depth` before it (Band::depth): rays
/// and edges then agree on what lies in the light's plane.
void trace_tasks(const RayScene& rays, const Receivers& receivers, const UnitLight& light, double depth,
                 std::span<RayTask> tasks);

/// True where a face hides the light's center from the receiver, beyond doubt: the first face that a
/// ray meets, by exact predicates.
bool is_hidden(const Scene& scene, const RayScene& rays, const Receivers& receivers, const UnitLight& light,
               double depth, std::uint32_t index);

}  // namespace penumbra::detail
