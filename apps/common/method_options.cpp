#include "apps/common/method_options.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <limits>
#include <span>

#include "render/d_buffer/d_buffer.h"

namespace penumbra::apps {
namespace {

/// An option whose words stand for values; an unknown word is refused with the list of known ones.
template <class Value>
CLI::Option* add_choice(CLI::App& command, const std::string& name, Value& value,
                        std::span<const NamedValue<Value>> choices, const std::string& help) {
  std::string words;
  for (const auto& c : choices) words.append(words.empty() ? "" : ", ").append(c.name);
  const auto set = [&value, choices, name, words](const std::string& word) {
    for (const auto& c : choices)
      if (word == c.name) return void(value = c.value);
    throw CLI::ValidationError(name, "'" + word + "' is none of " + words);
  };
  return command.add_option_function<std::string>(name, set, help + " (" + words + ")")
      ->default_str(name_in(choices, value))
      ->type_name("WORD");
}

void add_reference_options(CLI::App& command, ReferenceOptions& options) {
  const char* group =
      "Methods reference and rays: stratified rays to the disk (Embree), rays only where nothing is "
      "certified";
  command.add_option("--samples", options.samples, "Rays a pixel, rounded up to ⌊√N⌋ rows of equal length")
      ->check(CLI::Range(1, 1 << 20))
      ->capture_default_str()
      ->group(group);
  command.add_option("--seed", options.seed, "Two seeds give two independent images")
      ->capture_default_str()
      ->group(group);
}

void add_d_buffer_options(CLI::App& command, DBufferOptions& options) {
  const char* group = "Method dbuffer: what the light's center sees of the penumbra (OpenGL)";
  command
      .add_option("--dbuffer-size", options.size,
                  "Texels a side of the D-buffer, 16 to 8192; 0: the root of the image's pixels")
      ->check(CLI::Range(16, 8'192) | CLI::IsMember({0}))
      ->capture_default_str()
      ->group(group);
  add_choice(command, "--dbuffer", options.contents, d_buffer_contents(),
             "What a texel keeps: the edge that bounds the penumbra, or the 2004 paper's distances")
      ->group(group);
  command
      .add_option("--dbuffer-entries", options.entries,
                  "Entries a texel keeps, 1 or 2 (2: with edge and nearest)")
      ->check(CLI::Range(1, 2))
      ->capture_default_str()
      ->group(group);
  add_choice(command, "--visibility", options.curve, visibility_curves(),
             "Area beyond a chord: exact (of an edge: along the boundary that it is part of), smoothstep "
             "3t²-2t³, or sqrt √t")
      ->group(group);
  add_choice(command, "--conflict", options.conflict, conflicts(),
             "Which of several entries on a line of sight is kept")
      ->group(group);
  add_choice(command, "--dbuffer-center", options.center, center_tests(),
             "How it is told whether the light's center is hidden: by a ray, or by the texel's first surface")
      ->group(group);
  add_choice(command, "--dbuffer-check", options.check, entry_checks(),
             "Whether rays are asked where entries contradict each other (with edge and exact)")
      ->group(group);
}

void add_silhouette_options(CLI::App& command, SilhouetteOptions& options) {
  const char* group = "Method silhouette: exact area between the edges that each pixel sees (CPU)";
  command
      .add_option("--silhouette-rows", options.rows,
                  "Scanlines across the disk where many edges overlap; few edges are exact without")
      ->check(CLI::Range(4, 1024))
      ->capture_default_str()
      ->group(group);
  command
      .add_option("--silhouette-tolerance", options.tolerance,
                  "How far silhouettes of merged faces may lie from the true ones, light radii; 0: no faces "
                  "are merged")
      ->check(CLI::Range(0.0, 0.1))
      ->capture_default_str()
      ->group(group);
}

/// `auto`, `orthographic` or a number greater than 0.
void add_cop_offset(CLI::App& command, OcclusionOptions& options, const char* group) {
  const auto set = [&options](const std::string& text) {
    if (text == "auto") return options.cop_offset.reset();
    double value = std::numeric_limits<double>::infinity();
    const bool number = CLI::detail::lexical_cast(text, value) && std::isfinite(value) && value > 0.0;
    if (!number && text != "orthographic")
      throw CLI::ValidationError("--cop-offset",
                                 "'" + text + "' is none of auto, orthographic, a number > 0");
    options.cop_offset = number ? value : std::numeric_limits<double>::infinity();
  };
  command
      .add_option_function<std::string>("--cop-offset", set,
                                        "Distance of the center of projection behind the light, scene units "
                                        "(auto: as far as the frustum contains the casters; orthographic)")
      ->default_str("auto")
      ->type_name("WORD|NUMBER")
      ->group(group);
}

void add_occlusion_options(CLI::App& command, OcclusionOptions& options) {
  const char* group = "Method occlusion-textures: prefiltered slices parallel to the light";
  command.add_option("--slices", options.slices, "Slices of the scene")
      ->check(CLI::IsMember({4, 8, 12, 16}))
      ->capture_default_str()
      ->group(group);
  command.add_option("--texture-size", options.texture_size, "Texels a side of each slice")
      ->check(CLI::IsMember({128, 256, 512, 1024}))
      ->capture_default_str()
      ->group(group);
  add_choice(command, "--filter", options.filter, occlusion_filters(),
             "How a slice is averaged over the light")
      ->group(group);
  add_choice(command, "--combine", options.combine, occlusion_combines(), "How slices add up")->group(group);
  add_choice(command, "--kernel", options.kernel, occlusion_kernels(),
             "A disk light as one square of equal area or as strips")
      ->group(group);
  add_choice(command, "--thin-fix", options.thin_fix, thin_fixes(),
             "Draw each slice into the next one too; auto: for open and thin objects")
      ->group(group);
  add_choice(
      command, "--slice-range", options.range, slice_ranges(),
      "Depths that are sliced: of all or of casters; auto: of casters where they nearly touch a receiver")
      ->group(group);
  add_choice(command, "--coverage", options.coverage, slice_coverages(),
             "Texels by their centers or by eight samples")
      ->group(group);
  add_choice(command, "--slice-faces", options.faces, slice_faces(),
             "Which faces of closed casters are drawn: all, or what faces the light")
      ->group(group);
  add_cop_offset(command, options, group);
}

}  // namespace

void add_method_options(CLI::App& command, RenderOptions& options) {
  add_reference_options(command, options.reference);
  add_d_buffer_options(command, options.d_buffer);
  add_silhouette_options(command, options.silhouette);
  add_occlusion_options(command, options.occlusion);
}

}  // namespace penumbra::apps
