// The menus at the top of the panel, made from the table of commands.
#pragma once

#include <optional>

#include "apps/viewer/commands.h"
#include "apps/viewer/panel/widgets.h"

namespace penumbra::viewer {

struct MenuInput {
  bool can_undo = false, can_redo = false;
  bool several_files = false;
  bool close = false;  ///< an open menu is to close
};
/// In a window with a menu bar. The command that was chosen.
std::optional<Command> draw_menus(const MenuInput& input, Places& places);

}  // namespace penumbra::viewer
