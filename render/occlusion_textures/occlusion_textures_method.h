// The occlusion textures' registration.
#pragma once

#include "penumbra/render/method.h"

namespace penumbra {

/// The scene in prefiltered slices parallel to the light (occlusion_textures.h).
MethodInfo occlusion_textures_method();

/// The schema of its options.
std::vector<OptionSchema> occlusion_options();

}  // namespace penumbra
