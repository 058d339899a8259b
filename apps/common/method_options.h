// The options of every method, in one place.
#pragma once

#include "penumbra/render/renderer.h"

namespace CLI {
class App;
}

namespace penumbra::apps {

/// Adds one option group a method. Options of methods that are not rendered have no effect.
void add_method_options(CLI::App& command, RenderOptions& options);

}  // namespace penumbra::apps
