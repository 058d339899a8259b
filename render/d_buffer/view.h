// D-buffer step 3: from where and how wide the casters are seen.
//
// In: casters, light, texels a side. Out: the light's frame, the perspectives around the light that see all
// casters and their penumbrae, and how large the boundaries of casters are drawn there.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "render/d_buffer/casters.h"
#include "render/d_buffer/entries/entry_footprint.h"
#include "render/d_buffer/entries/targets.h"

namespace penumbra::detail {

/// What drawing and shading know of the light and of the D-buffer's targets.
struct DBufferView {
  /// World → the light's frame.
  LightSpace space;
  /// Caster frame → the light's frame: axes · p + offset.
  glm::mat3 axes;
  glm::vec3 offset;
  /// None where nothing casts, one where a single perspective is wide enough, else sides of a hemicube.
  std::vector<Target> targets{};
  FootprintOptions footprint{};

  double radius() const { return space.radius; }
  bool is_hemicube() const { return targets.size() > 1; }
};

/// The view of all casters that can occlude. `size`: texels a side. Cost O(vertices).
DBufferView choose_view(const Scene& scene, const std::vector<DBufferCaster>& casters,
                        const CasterFrame& frame, const DiskLight& light, int size);

}  // namespace penumbra::detail
