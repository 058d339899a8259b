// The method smoothies: a hard shadow with a fake penumbra outside of it, from fins at silhouettes.
//
// In: casters, a near light, receivers. Out: V of each receiver, by two maps of the light's center.
//
//   1. map      the casters (center_view/shadow_map.h)
//   2. fins     smoothies along the silhouettes of the center, of one width in the map (smoothie_map.h)
//   3. look-up  0 where a caster is nearer to the light than the receiver; below a fin τ = alpha / (1 - z_fin
//               / z_receiver), z depths before the light, and V = 3τ² - 2τ³; else 1
//
// With z the depth of an edge, a light of radius r has an outer penumbra r D (1 - z / z_receiver) / z wide in
// a map at the depth D. So a width of r D / z is right for one depth z: that of the mean edge.
//
// E. Chan, F. Durand, "Rendering fake soft shadows with smoothies" (2003); the profile: S. Parker, P.
// Shirley, B. Smits, "Single sample soft shadows" (1998); "Casting Shadows in Real Time" (2009), section
// 5.3.1. A rectangle counts as a disk of its area.
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

struct SmoothieOptions {
  /// Texels a side of the maps.
  int map_size = 1024;
  /// What is not this much higher than the receiver hides nothing from it.
  detail::MapBias bias;
  /// Times the width that is right for the mean edge.
  double width = 1.0;
};

/// Requires a near light that is no point. The horizon is a factor of its own. Cost O(faces + texels), the
/// fins' texels, and O(1) a receiver. On all threads; the result does not depend on their number. Throws
/// Cancelled.
MethodResult smoothie_visibility(const Scene& scene, const LightShape& light, const Receivers& receivers,
                                 const SmoothieOptions& options, bool keep_textures, tbb::task_arena& threads,
                                 const Progress& progress);

}  // namespace penumbra
