// The method pcss: percentage-closer soft shadows.
//
// In: casters, a light, receivers. Out: V of each receiver, by a shadow map of the light's center alone.
//
//   1. map     what the center sees first (center_view/shadow_map.h)
//   2. search  samples of the map in the window that the light, seen from the receiver, covers of the plane
//              of the highest caster. The mean depth of those between the receiver and the light is that of
//              the blocker.
//   3. filter  samples of the map in the window that the light covers of the blocker's plane. The share of
//              them that lies between the receiver and the light is hidden.
//
// R. Fernando, "Percentage-closer soft shadows" (2005); "Casting Shadows in Real Time" (2009), section 5.2.2.
// In the coordinates of a LightProjection the width of the second window is spread · (height of the blocker -
// height of the receiver). That is the course's w_light (z - z_avg) / z_avg, taken to the map. A receiver's
// plane as bias: J. Isidoro, "Shadow mapping: GPU-based tips and techniques" (2006).
#pragma once

#include <tbb/task_arena.h>

#include <vector>

#include "penumbra/mesh/progress.h"
#include "penumbra/mesh/stage_clock.h"
#include "penumbra/render/method.h"
#include "penumbra/render/receivers/receivers.h"
#include "penumbra/render/scene/scene.h"
#include "render/center_view/map_options.h"
#include "render/light/area_light.h"

namespace penumbra {

struct PcssOptions {
  /// Texels a side of the map.
  int map_size = 1024;
  /// Of each step, a receiver.
  int search_samples = 64, filter_samples = 64;
  /// What is not this much higher than the receiver hides nothing from it.
  detail::MapBias bias;
  /// Samples are compared with the receiver's plane, else with its point.
  bool receiver_plane = true;
};

/// Requires a light that is no point. The horizon is a factor of its own. Cost O(faces + texels), and
/// O(samples) a receiver. On all threads; the result does not depend on their number. Throws Cancelled.
MethodResult pcss_visibility(const Scene& scene, const AreaLight& light, const Receivers& receivers,
                             const PcssOptions& options, bool keep_textures, tbb::task_arena& threads,
                             const Progress& progress);

}  // namespace penumbra
