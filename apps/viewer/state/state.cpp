#include "apps/viewer/state/state.h"

#include "apps/viewer/state/state_file.h"
#include "penumbra/mesh/error.h"

namespace penumbra::viewer {

Scene current_scene(const State& state) {
  Scene scene = *state.model;
  scene.light = state.light;
  scene.radiance = state.radiance;
  scene.camera = state.camera;
  return scene;
}

State opened(const std::filesystem::path& path, LoadedScene& loaded, const State& before) {
  State state = before;
  state.path = path;
  state.light = loaded.scene.light;
  state.radiance = loaded.scene.radiance;
  state.camera = loaded.scene.camera;
  state.model = std::make_shared<const Scene>(std::move(loaded.scene));
  const auto settings = state.model->document.find("x-viewer");
  if (settings == state.model->document.end()) return state;
  try {
    State changed = state;
    read_viewer_settings(*settings, changed);
    return changed;
  } catch (const Error& e) {
    loaded.warnings.push_back(path.string() + ": /x-viewer: " + e.what() + "; ignored");
  } catch (const nlohmann::json::exception& e) {
    loaded.warnings.push_back(path.string() + ": /x-viewer: " + e.what() + "; ignored");
  }
  return state;
}

}  // namespace penumbra::viewer
