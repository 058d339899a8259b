// How far the volumes of a scene reach, the same for every program.
#pragma once

#include "penumbra/render/scene/scene.h"
#include "penumbra/volumes/extrude.h"

namespace penumbra::apps {

/// The bound is a sphere around all objects and this light: every volume reaches beyond it.
ExtrudeOptions extrude_options_for(const Scene& scene, const DiskLight& light);

}  // namespace penumbra::apps
