#include "apps/common/picture_options.h"

#include <CLI/CLI.hpp>
#include <cmath>

#include "apps/common/messages.h"
#include "penumbra/mesh/error.h"
#include "penumbra/mesh/io/polygon_soup.h"

namespace penumbra::apps {
namespace {

constexpr double kMostAmbient = 1e6;
// Of glass; see GlassBody.
const Vec3 kPenumbraTint(1.0, 0.52, 0.13), kUmbraTint(0.02, 0.05, 0.3);
constexpr double kPenumbraDensity = 0.35, kUmbraDensity = 0.99;

// Not CLI::Range, which lets NaN through.
std::string require_ambient(const std::string& text) {
  double value = 0.0;
  const bool good = CLI::detail::lexical_cast(text, value) && value >= 0.0 && value <= kMostAmbient;
  return good ? "" : text + " is no radiance in [0 - 1000000]";
}

std::string require_background(const std::string& text) {
  try {
    parse_background(text);
    return "";
  } catch (const UsageError& e) {
    return e.what();
  }
}

void add_glass(const std::vector<std::filesystem::path>& meshes, const Vec3& tint, double density,
               Scene& scene) {
  for (const std::filesystem::path& path : meshes) {
    scene.glass.push_back({.mesh = read_mesh(path), .tint = tint, .density = density});
    scene.files.push_back(path);
  }
}

}  // namespace

void add_picture_options(CLI::App& command, PictureOptions& options) {
  command
      .add_option(
          "--antialias", options.antialias,
          "N: means over N x N samples a pixel, each a whole frame; other channels than R G B A stay those "
          "of the pixel's center (1, of a bare mesh 2)")
      ->check(CLI::Range(1, kMostAntialias))
      ->type_name("N");
  command
      .add_option("--ambient", options.ambient,
                  "Fill light for R G B: the radiance of a sky that nothing hides, 0 for none (0, of a bare "
                  "mesh 0.11)")
      ->check(require_ambient)
      ->type_name("X");
  command
      .add_option_function<std::string>(
          "--background",
          [&options](const std::string& text) { options.background = parse_background(text); },
          "What a PNG shows where no surface is seen: #rrggbb, white, black, or transparent for a PNG with "
          "alpha "
          "(#e6e6e6)")
      ->check(require_background)
      ->type_name("COLOR");
  command.add_flag("--shadow-catcher", options.shadow_catcher,
                   "Of objects that do not cast, such as floors, show only the shadow on them, by alpha");
  command
      .add_option("--show-penumbra", options.penumbras,
                  "A closed mesh to show as clear amber glass over the picture, such as a solid that "
                  "penumbra volumes wrote; "
                  "may be repeated")
      ->allow_extra_args(false)
      ->type_name("MESH");
  command.add_option("--show-umbra", options.umbras, "The same as dark blue glass")
      ->allow_extra_args(false)
      ->type_name("MESH");
  command.add_flag("--show-lights", options.show_lights,
                   "Show near lights that the camera sees, as bright as they are");
}

void apply(const PictureOptions& options, Scene& scene) {
  if (options.antialias) scene.picture.antialias = *options.antialias;
  if (options.ambient) scene.picture.ambient = Vec3(*options.ambient);
  if (options.background) scene.picture.background = *options.background;
  if (options.show_lights) scene.picture.show_lights = true;
  add_glass(options.penumbras, kPenumbraTint, kPenumbraDensity, scene);
  add_glass(options.umbras, kUmbraTint, kUmbraDensity, scene);
  if (!options.shadow_catcher) return;
  bool any = false;
  for (SceneObject& object : scene.objects) {
    object.shadow_catcher = object.shadow_catcher || !object.casts;
    any = any || object.shadow_catcher;
  }
  if (!any) say_ignored("--shadow-catcher", "all objects of the scene cast shadows");
}

}  // namespace penumbra::apps
