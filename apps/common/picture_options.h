// Options of how a picture looks: they change no visibility.
#pragma once

#include <optional>
#include <string>

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
};

/// --antialias, --ambient, --background and --shadow-catcher.
void add_picture_options(CLI::App& command, PictureOptions& options);

/// Gives the scene what was given. Objects that do not cast become shadow catchers where that was asked for; a line says
/// where there is none.
void apply(const PictureOptions& options, Scene& scene);

}  // namespace penumbra::apps
