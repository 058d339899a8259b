// Silhouette method: one receiver of a tile, in the light's frame.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>

#include "penumbra/mesh/types.h"
#include "render/light/disk_area.h"

namespace penumbra::detail {

/// The chord of a receiver whose tangent plane leaves the whole disk in view.
inline Chord no_horizon() {
  return {glm::dvec2(0.0), 2.0};
}

/// It lies in front of the light and has some of the disk above its tangent plane.
struct TileReceiver {
  /// The point, and the unit normal of its tangent plane on the viewer's side.
  Vec3 x, normal;
  /// Where the tangent plane cuts the disk; else no_horizon.
  Chord horizon;
  bool horizon_cuts = false;
  /// Which of the receivers it is.
  std::uint32_t index = 0;
};

}  // namespace penumbra::detail
