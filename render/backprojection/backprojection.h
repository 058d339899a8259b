// The method backprojection: texels of a shadow map, seen from each receiver, hide parts of the light.
//
// In: casters, a light, receivers. Out: V of each receiver, by a shadow map of the light's center, or several
// layers of it.
//
//   1. map      what the center sees first, second, ... (center_view/shadow_map.h)
//   2. patches  texels that lie between the receiver and its light, each a rectangle parallel to it
//               (patch_tree.h)
//   3. masks    the samples of the light that they hide (light_masks.h)
//
// G. Guennebaud, L. Barthe, M. Paulin, "Real-time soft shadow mapping by backprojection" (2006); M. Schwarz,
// M. Stamminger, "Bitmask soft shadows" (2007); L. Bavoil, S. Callahan, C. Silva, "Robust soft shadow mapping
// with backprojection and depth peeling" (2008); "Casting Shadows in Real Time" (2009), section 5.2.3.
#pragma once

#include <tbb/task_arena.h>

#include <vector>

#include "penumbra/mesh/progress.h"
#include "penumbra/mesh/stage_clock.h"
#include "penumbra/render/method.h"
#include "penumbra/render/receivers/receivers.h"
#include "penumbra/render/scene/scene.h"
#include "render/backprojection/patch_tree.h"
#include "render/light/area_light.h"

namespace penumbra {

struct BackprojectionOptions {
  /// Texels a side of the map.
  int map_size = 128;
  /// Surfaces a texel.
  int layers = 1;
  /// Of the light, the same for all receivers.
  int samples = 256;
  detail::PatchOptions patches;
};

/// Requires a light that is no point. Cost O(faces + texels) a layer, and for each receiver the texels in
/// front of its light. On all threads; the result does not depend on their number. Throws Cancelled.
MethodResult backprojected_visibility(const Scene& scene, const AreaLight& light, const Receivers& receivers,
                                      const BackprojectionOptions& options, bool keep_textures,
                                      tbb::task_arena& threads, const Progress& progress);

}  // namespace penumbra
