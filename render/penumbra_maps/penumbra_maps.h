// The method penumbra-maps: a hard shadow with a penumbra added outside of it.
//
// In: casters, a light, receivers. Out: V of each receiver, by two maps of the light's center.
//
//   1. maps      the casters, and the first surface of all objects and receivers, casting or not
//                (center_view/shadow_map.h)
//   2. penumbra  around each silhouette edge of the center: cones and sheets over the light, drawn into a
//                third map (penumbra_map.h)
//   3. look-up   0 where a caster is nearer to the light than the receiver, else what the third map has
//
// C. Wyman, C. Hansen, "Penumbra maps: approximate soft shadows in real-time" (2003); "Casting Shadows in
// Real Time" (2009), section 5.3.1. A rectangle counts as a disk of its area.
#pragma once

#include <tbb/task_arena.h>

#include <vector>

#include "penumbra/mesh/progress.h"
#include "penumbra/mesh/stage_clock.h"
#include "penumbra/render/method.h"
#include "penumbra/render/receivers/receivers.h"
#include "penumbra/render/scene/scene.h"
#include "render/center_view/map_options.h"

namespace penumbra {

struct PenumbraMapOptions {
  /// Texels a side of the maps.
  int map_size = 1024;
  /// What is not this much higher than the receiver hides nothing from it.
  detail::MapBias bias;
};

/// Requires a light that is no point. The horizon is a factor of its own. Cost O(faces + texels), the
/// penumbras's texels, and O(1) a receiver. On all threads; the result does not depend on their number.
/// Throws Cancelled.
MethodResult penumbra_map_visibility(const Scene& scene, const LightShape& light, const Receivers& receivers,
                                     const PenumbraMapOptions& options, bool keep_textures,
                                     tbb::task_arena& threads, const Progress& progress);

}  // namespace penumbra
