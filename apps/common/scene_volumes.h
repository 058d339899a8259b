// How far the volumes of a scene reach, the same for every program.
#pragma once

#include "penumbra/render/scene/scene.h"
#include "penumbra/volumes/extrude.h"

namespace penumbra::apps {

/// The bound is a sphere around all objects, and the light where it is no further away than ten times their
/// size. Every volume reaches beyond it.
ExtrudeOptions extrude_options_for(const Scene& scene, const CircularLight& light);

/// The box in which solids end and fields lie: that of all objects and a little more; that of a lone object,
/// grown by its diagonal on all sides.
Bounds solid_bound_for(const Scene& scene);

}  // namespace penumbra::apps
