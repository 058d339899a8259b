// The panel beside the picture: menus, picture, light, overlays, cost.
#pragma once

#include <optional>

#include "apps/viewer/panel/menus.h"
#include "apps/viewer/state/state.h"
#include "apps/viewer/work/costs.h"
#include "apps/viewer/work/render_worker.h"

namespace penumbra::viewer {

struct PanelInput {
  const Frame* frame;  ///< what is shown; null before the first
  const Costs& costs;
  MenuInput menus;
  int x, width, height;  ///< its place in the window
};

/// Draws the panel and changes the state as its widgets are used. The command of a menu is returned.
std::optional<Command> draw_panel(State& state, const PanelInput& input, Places& places);

}  // namespace penumbra::viewer
