#include "apps/viewer/panel/menus.h"

#include <utility>

namespace penumbra::viewer {
namespace {

bool is_possible(Command command, const MenuInput& input) {
  switch (command) {
    case Command::kUndo:
      return input.can_undo;
    case Command::kRedo:
      return input.can_redo;
    case Command::kNextFile:
    case Command::kPreviousFile:
      return input.several_files;
    default:
      return true;
  }
}

}  // namespace

std::optional<Command> draw_menus(const MenuInput& input, Places& places) {
  std::optional<Command> chosen;
  if (!ImGui::BeginMenuBar()) return chosen;
  for (const auto& [menu, name] : {std::pair(Menu::kFile, "File"),
                                   {Menu::kEdit, "Edit"},
                                   {Menu::kView, "View"},
                                   {Menu::kPicture, "Picture"},
                                   {Menu::kHelp, "Help"}}) {
    const bool open = ImGui::BeginMenu(name);
    note_place(places, std::string("menu ") + name);
    if (!open) continue;
    for (const CommandKey& each : command_keys()) {
      if (each.menu != menu || &each != &key_of(each.command)) continue;
      if (ImGui::MenuItem(each.label, each.shown, false, is_possible(each.command, input)))
        chosen = each.command;
      note_place(places, each.label);
    }
    if (input.close) ImGui::CloseCurrentPopup();
    ImGui::EndMenu();
  }
  ImGui::EndMenuBar();
  return chosen;
}

}  // namespace penumbra::viewer
