#include "apps/viewer/actions.h"

#include <imgui.h>

#include "apps/viewer/state/state_file.h"
#include "apps/viewer/work/fresh_name.h"
#include "penumbra/mesh/error.h"

namespace penumbra::viewer {
namespace {

std::filesystem::path fresh_name(const ActionInput& input, const std::string& end) {
  return input.folder / (fresh_stem(input.folder, input.state, {end}) + end);
}

std::string save_picture(const ActionInput& input) {
  if (!input.frame || !input.settled || input.frame->sides.empty())
    return "the picture is not final yet; try again in a moment";
  const std::filesystem::path path = fresh_name(input, ".png");
  write_png(path, input.frame->sides.front().result->image,
            Display{input.state.exposure, input.frame->model->picture.background});
  return "saved " + path.string();
}

std::filesystem::path save_state_file(const ActionInput& input) {
  const std::filesystem::path path = fresh_name(input, ".json");
  save_state(path, input.state);
  return path;
}

std::string copy_command(const ActionInput& input) {
  const std::string command = headless_command(save_state_file(input), input.state);
  ImGui::SetClipboardText(command.c_str());
  return "copied: " + command;
}

}  // namespace

ActionResult perform(Command command, const ActionInput& input) {
  try {
    switch (command) {
      case Command::kSavePicture:
        return {save_picture(input)};
      case Command::kSaveState:
        return {"saved " + save_state_file(input).string(), true};
      case Command::kCopyCommand:
        return {copy_command(input), true};
      default:
        return {};
    }
  } catch (const std::exception& e) {
    return {e.what()};
  }
}

}  // namespace penumbra::viewer
