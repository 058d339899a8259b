// The method layered-attenuation: many shadow maps, taken back to one view.
//
// In: a scene, a light, receivers that are a picture's pixels. Out: V of each receiver, the share of the
// light's points from which its surface is seen.
//
//   1. map      the surfaces that each point of the light sees first, as layers of the center's view
//               (attenuation_map.h)
//   2. look-up  the layer at the receiver's height; where there is none no point sees the receiver
//
// M. Agrawala, R. Ramamoorthi, A. Heirich, L. Moll, "Efficient image-based methods for rendering soft
// shadows" (2000), section 4; "Casting Shadows in Real Time" (2009), section 5.2.4.
#pragma once

#include <tbb/task_arena.h>

#include <vector>

#include "penumbra/mesh/progress.h"
#include "penumbra/mesh/stage_clock.h"
#include "penumbra/render/method.h"
#include "penumbra/render/receivers/receivers.h"
#include "penumbra/render/scene/scene.h"
#include "render/layered_attenuation/attenuation_map.h"
#include "render/light/area_light.h"

namespace penumbra {

/// Requires a light that is no point. Cost O(views · (faces + texels)), and O(layers) a receiver. The result
/// does not depend on the number of threads. Throws Cancelled.
MethodResult layered_attenuation(const Scene& scene, const AreaLight& light, const Receivers& receivers,
                                 const detail::AttenuationOptions& options, bool keep_textures,
                                 tbb::task_arena& threads, const Progress& progress);

}  // namespace penumbra
