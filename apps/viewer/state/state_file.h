// Saving a state as a scene file that `penumbra render` reads like any other.
#pragma once

#include <nlohmann/json.hpp>

#include "apps/viewer/state/state.h"

namespace penumbra::viewer {

/// The scene's document with light and camera of now, mesh paths that start at `path`'s folder, and the
/// viewer's own settings below "x-viewer". Objects that have no file (the floor of a bare mesh) are written
/// beside it. Whole or not at all. Throws SystemError.
void save_state(const std::filesystem::path& path, const State& state);

/// Reads what save_state put below "x-viewer". Throws Error for what it does not understand.
void read_viewer_settings(const nlohmann::json& settings, State& state);

/// The command line that renders the picture of the left method without a window. `scene` is where the state
/// was saved.
std::string headless_command(const std::filesystem::path& scene, const State& state);

}  // namespace penumbra::viewer
