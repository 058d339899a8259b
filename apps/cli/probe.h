// render --probe: everything known about one pixel.
#pragma once

#include <nlohmann/json.hpp>

#include "apps/common/options.h"
#include "penumbra/render/renderer.h"

namespace penumbra::apps {

/// Object, face, P, N, visibility, region and rgb of the pixel; where another method than `reference` made
/// the picture also the reference's visibility from 4,096 rays at that point. With several lights visibility,
/// region and reference are objects by the lights' names.
nlohmann::json probe_pixel(const Scene& scene, const RenderResult& result, int threads,
                           const PixelPair& pixel);

}  // namespace penumbra::apps
