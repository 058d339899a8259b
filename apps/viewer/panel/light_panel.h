// The panel's part about lights: which one is edited, and its numbers.
#pragma once

#include "apps/viewer/panel/widgets.h"
#include "apps/viewer/state/state.h"

namespace penumbra::viewer {

/// Draws it and changes the state's lights as its widgets are used.
void light_section(State& state, Places& places);

}  // namespace penumbra::viewer
