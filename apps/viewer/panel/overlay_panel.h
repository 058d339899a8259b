// The panel's part about what is drawn over the picture, and where it is cut.
#pragma once

#include "apps/viewer/panel/widgets.h"
#include "apps/viewer/state/state.h"

namespace penumbra::viewer {

/// Draws it and changes the state as its widgets are used.
void overlay_section(State& state, Places& places);

}  // namespace penumbra::viewer
