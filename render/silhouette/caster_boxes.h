// Silhouette method: each caster as a few boxes that together hold its faces, made once for every light.
#pragma once

#include <span>
#include <vector>

#include "penumbra/render/scene/scene.h"

namespace penumbra::detail {

class CasterBoxes {
 public:
  /// Cost O(F log F) for casters of F faces.
  explicit CasterBoxes(const Scene& scene);
  /// Of an object by its index in the scene; none where it does not cast.
  std::span<const Bounds> of(std::size_t object) const { return boxes_[object]; }

 private:
  std::vector<std::vector<Bounds>> boxes_;
};

}  // namespace penumbra::detail
