// Options of how a picture looks: they change no visibility.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "penumbra/render/scene/scene.h"

namespace CLI {
class App;
}

namespace penumbra::apps {

/// What was given; the scene's own settings hold for the rest.
struct PictureOptions {
  std::optional<int> antialias;
  std::optional<double> ambient;
  std::optional<Background> background;
  bool shadow_catcher = false;
  bool show_lights = false;
  /// Meshes that are shown as glass.
  std::vector<std::filesystem::path> umbras{}, penumbras{};
};

/// --antialias, --ambient, --background, --shadow-catcher, --show-umbra, --show-penumbra and --show-lights.
void add_picture_options(CLI::App& command, PictureOptions& options);

/// Gives the scene what was given; reads the meshes. Throws MeshError. Objects that do not cast become shadow
/// catchers where that was asked for; a line says where there is none.
void apply(const PictureOptions& options, Scene& scene);

}  // namespace penumbra::apps
