// Lights that light nothing in a picture: a scene's mistake more often than its meaning.
#pragma once

#include <string>
#include <vector>

#include "penumbra/render/renderer.h"

namespace penumbra::apps {

/// One line for each light of which no surface in the picture sees anything: that it is so, and what may be the
/// reason. `result` is a picture of `scene`.
std::vector<std::string> unlit_lights(const Scene& scene, const RenderResult& result);

}  // namespace penumbra::apps
