#include "apps/viewer/state/state.h"

#include <nlohmann/json.hpp>

#include "apps/viewer/state/state_file.h"
#include "penumbra/mesh/error.h"

namespace penumbra::viewer {

CircularLight State::circular() const {
  if (const auto* distant = std::get_if<DistantLight>(&shape())) return *distant;
  return disk_around(shape());
}

void State::set_shape(const LightShape& shape) {
  Light& light = lights[selected];
  const auto *before = std::get_if<DistantLight>(&light.shape), *after = std::get_if<DistantLight>(&shape);
  if (before && after && before->angle_degrees != after->angle_degrees)
    light.radiance *= irradiance_per_radiance(*before) / irradiance_per_radiance(*after);
  light.shape = shape;
}

Scene current_scene(const State& state) {
  Scene scene = *state.model;
  scene.lights = state.lights;
  scene.camera = state.camera;
  return scene;
}

State opened(const std::filesystem::path& path, LoadedScene& loaded, const State& before) {
  State state = before;
  state.path = path;
  state.lights = loaded.scene.lights;
  state.selected = 0;
  state.camera = loaded.scene.camera;
  state.model = std::make_shared<const Scene>(std::move(loaded.scene));
  state.casters = state.model->caster_bounds();
  if (state.casters.empty()) state.casters = state.model->bounds();
  const nlohmann::json document = nlohmann::json::parse(state.model->document);
  const auto settings = document.find("x-viewer");
  if (settings == document.end()) return state;
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
