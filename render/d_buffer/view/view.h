// D-buffer step 3: from where and how wide the casters are seen.
//
// In: casters and receivers in light space, texels a side. Out: the window of the light's view, the
// perspectives that see in it all casters and their penumbras, and how large the boundaries of casters are
// drawn there. The window is what both the casters' penumbras and the receivers are seen in: nobody reads the
// rest.
#pragma once

#include <vector>

#include "render/d_buffer/view/casters.h"
#include "render/d_buffer/view/receivers_in_light.h"
#include "render/d_buffer/view/targets.h"

namespace penumbra::detail {

/// How large boundaries are drawn.
struct FootprintOptions {
  /// h of the lowest receiver: boundaries end there.
  double far_height;
  /// In (u, v): polygons grow by this to all sides, so that every texel they touch is drawn.
  double dilation;
  /// In (u, v): of what is no wider than this one ray tells the reach as well as three.
  double narrow;
  /// The dilation is multiplied by 1 + |uv|, as the texels of a hemicube grow.
  bool is_hemicube;
  /// Of one target: half the greater width of its window, which is about (0, 0).
  double half_window;
};

/// What drawing and shading know of the light and of the D-buffer's targets.
struct DBufferView {
  /// With the window.
  LightSpace space;
  /// None where nothing casts on a receiver, one where a single perspective is wide enough, else sides of a
  /// hemicube.
  std::vector<Target> targets{};
  /// Depths that are stored are depth_scale · h · weight / forward.
  double depth_scale = 1.0;
  FootprintOptions footprint{};

  bool is_hemicube() const { return targets.size() > 1; }
};

/// The view of all casters that can occlude. `space` has no window yet; `size`: texels a side. Cost
/// O(vertices + receivers / 64).
DBufferView choose_view(const LightSpace& space, const CasterTriangles& triangles,
                        const CastersInLight& casters, const ReceiversInLight& receivers, int size);

}  // namespace penumbra::detail
