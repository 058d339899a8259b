#include "apps/viewer/state/state.h"

#include <nlohmann/json.hpp>

#include "apps/viewer/state/state_file.h"
#include "penumbra/mesh/error.h"

namespace penumbra::viewer {

void State::set_light(const DiskLight& disk) {
  LightShape& shape = lights[selected].shape;
  if (std::holds_alternative<DiskLight>(shape)) {
    shape = disk;
    return;
  }
  auto& rectangle = std::get<RectangleLight>(shape);
  const double before = disk_around(rectangle).radius;
  if (disk.radius > 0.0 && disk.radius != before) rectangle.half_extents *= disk.radius / before;
  rectangle.center = disk.center;
  rectangle.normal = disk.normal;
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
