// How far the volumes of a scene reach, the same for every program.
#pragma once

#include "render/scene.h"
#include "volumes/extrude.h"

namespace penumbra::apps {

/// The bound is a sphere around everything, light included: every volume reaches beyond it.
ExtrudeOptions extrude_options_for(const Scene& scene);

}  // namespace penumbra::apps
