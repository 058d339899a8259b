#include <imgui.h>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include "apps/viewer/actions.h"
#include "apps/viewer/state/state_commands.h"
#include "apps/viewer/viewer.h"

namespace penumbra::viewer {

void Viewer::keys() {
  const std::vector<Window::Key> pressed = window_.take_keys();
  if (browser_.shown() || question_.shown()) {
    for (const Window::Key& key : pressed)
      if (key.key == GLFW_KEY_ESCAPE) {
        browser_.hide();
        question_.hide();
      }
    return;
  }
  if (ImGui::GetIO().WantTextInput) return;
  for (const Window::Key& key : pressed)
    for (const CommandKey& each : command_keys())
      if (each.key == key.key && each.shift == key.shift && each.control == key.control) obey(each.command);
}

void Viewer::obey(Command command) {
  if (change_state(state(), command)) return;
  switch (command) {
    case Command::kPanel:
      show_panel_ = !show_panel_;
      break;
    case Command::kHelp:
      show_help_ = !show_help_;
      break;
    case Command::kUndo:
      if (!holding_) message_ = document_.undo();
      break;
    case Command::kRedo:
      if (!holding_) message_ = document_.redo();
      break;
    case Command::kLeave:
      escape();
      break;
    default:
      obey_file(command);
  }
}

void Viewer::obey_file(Command command) {
  switch (command) {
    case Command::kOpen:
      browser_.show(state().path.parent_path());
      break;
    case Command::kNextFile:
      open_neighbor(1);
      break;
    case Command::kPreviousFile:
      open_neighbor(-1);
      break;
    case Command::kExportSolids:
      message_ = exports_.start(kSolidExport, options_.output, state());
      break;
    case Command::kExportCells:
      message_ = exports_.start(kCellExport, options_.output, state());
      break;
    case Command::kExportSequence:
      message_ = exports_.start(kSequenceExport, options_.output, state());
      break;
    default: {
      const ActionResult result = perform(
          command,
          {.state = state(), .frame = canvas_.frame(), .settled = settled(), .folder = options_.output});
      message_ = result.message;
      if (result.saved_state) document_.note_saved();
    }
  }
}

// Ends what is nearest: a drag, a menu, the help, an export; then the program.
void Viewer::escape() {
  if (pointer_.dragging())
    pointer_.cancel(state());
  else if (ImGui::IsPopupOpen(nullptr, ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel))
    close_menus_ = true;
  else if (show_help_)
    show_help_ = false;
  else if (exports_.busy())
    exports_.cancel();
  else
    want_to_leave();
}

void Viewer::want_to_leave() {
  if (document_.unsaved())
    question_.ask(std::nullopt);
  else
    leaving_ = true;
}

void Viewer::want_to_open(const std::filesystem::path& path) {
  if (document_.unsaved())
    question_.ask(path);
  else
    open(path);
}

void Viewer::answer(UnsavedQuestion::Answer answer) {
  if (answer == UnsavedQuestion::Answer::kStay) return;
  if (answer == UnsavedQuestion::Answer::kSave) {
    obey(Command::kSaveState);
    if (document_.unsaved()) return;  // the message says why
  }
  if (question_.then())
    open(*question_.then());
  else
    leaving_ = true;
}

void Viewer::open(const std::filesystem::path& path) {
  try {
    Document opened(path, state(), options_.plain);
    document_ = std::move(opened);
    message_ = document_.warnings().empty() ? "" : document_.warnings().front();
    name_window();
  } catch (const std::exception& e) {
    message_ = e.what();
  }
  frames_to_draw_ = 3;
}

void Viewer::open_neighbor(int step) {
  const std::size_t count = options_.files.size();
  if (count < 2) return;
  file_ = (file_ + count + static_cast<std::size_t>(step + static_cast<int>(count))) % count;
  want_to_open(options_.files[file_]);
}

void Viewer::name_window() {
  window_.set_title(state().path.filename().string() + " - Penumbra");
}

}  // namespace penumbra::viewer
