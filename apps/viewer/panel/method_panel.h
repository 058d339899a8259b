// The panel's part about the picture: methods and their options, what is shown of it, exposure.
#pragma once

#include "apps/viewer/panel/widgets.h"
#include "apps/viewer/state/state.h"

namespace penumbra::viewer {

/// Draws it and changes the state as its widgets are used.
void picture_section(State& state, Places& places);

}  // namespace penumbra::viewer
