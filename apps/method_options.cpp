#include "apps/method_options.h"

#include <CLI/CLI.hpp>
#include <span>

#include "render/d_buffer.h"

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
  command.add_option("--dbuffer-size", options.size, "Texels a side of the D-buffer")
      ->check(CLI::Range(16, 8'192))
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
  add_choice(
      command, "--visibility", options.curve, visibility_curves(),
      "Area beyond a chord: exact (with the neighbouring edge at corners), smoothstep 3t²-2t³, or sqrt √t")
      ->group(group);
  add_choice(command, "--conflict", options.conflict, conflicts(),
             "Which of several entries on a line of sight is kept")
      ->group(group);
  add_choice(command, "--dbuffer-center", options.center, center_tests(),
             "How it is told whether the light's center is hidden: by a ray, or by the texel's first surface")
      ->group(group);
}

void add_silhouette_options(CLI::App& command, SilhouetteOptions& options) {
  command
      .add_option("--silhouette-rows", options.rows,
                  "Scanlines across the disk where many edges overlap; few edges are exact without")
      ->check(CLI::Range(4, 1024))
      ->capture_default_str()
      ->group("Method silhouette: exact area between the edges that each pixel sees (CPU)");
}

}  // namespace

void add_method_options(CLI::App& command, RenderOptions& options) {
  add_reference_options(command, options.reference);
  add_d_buffer_options(command, options.d_buffer);
  add_silhouette_options(command, options.silhouette);
}

}  // namespace penumbra::apps
