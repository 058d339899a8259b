#include "apps/viewer/state/document.h"

#include <nlohmann/json.hpp>

#include "apps/viewer/handles/opening_view.h"

namespace penumbra::viewer {
namespace {

bool has_viewer_settings(const State& state) {
  return nlohmann::json::parse(state.model->document).contains("x-viewer");
}

}  // namespace

Document::Document(const std::filesystem::path& path, const State& before, bool keep_camera) {
  LoadedScene loaded = load_scene(path);
  state_ = opened(path, loaded, before);
  state_.revision = before.revision + 1;
  warnings_ = std::move(loaded.warnings);
  if (!keep_camera && !has_viewer_settings(state_))
    state_.camera = with_light_in_view(state_.camera, *state_.model, state_.handled(), state_.left.width,
                                       state_.left.height);
  begin();
}

void Document::begin() {
  saved_lights_ = state_.lights;
  history_.begin(state_);
}

std::string Document::undo() {
  const std::string what = history_.undo(state_);
  return what.empty() ? "nothing to undo" : "undone: " + what;
}

std::string Document::redo() {
  const std::string what = history_.redo(state_);
  return what.empty() ? "nothing to redo" : "done again: " + what;
}

}  // namespace penumbra::viewer
