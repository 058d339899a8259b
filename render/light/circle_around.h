// A disk, near or distant, that holds a light: for what is done in a frame in which lights are unit disks.
#pragma once

#include "penumbra/render/light/light.h"

namespace penumbra::detail {

/// The light itself, or the smallest disk around a rectangle.
inline CircularLight circle_around(const LightShape& shape) {
  if (const auto* sun = std::get_if<DistantLight>(&shape)) return *sun;
  return disk_around(shape);
}

}  // namespace penumbra::detail
