// penumbra render: one image of a scene.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>

#include "apps/cli/commands.h"
#include "apps/cli/made_by.h"
#include "apps/cli/plan/effect_option.h"
#include "apps/cli/plan/plan_json.h"
#include "apps/cli/probe.h"
#include "apps/common/messages.h"
#include "apps/common/method_options.h"
#include "apps/common/options.h"
#include "apps/common/outputs.h"
#include "apps/common/picture_options.h"
#include "apps/common/stats.h"
#include "penumbra/mesh/error.h"
#include "penumbra/render/renderer.h"

namespace penumbra::apps {
namespace {

constexpr const char* kFooter = R"(Examples:
  penumbra render bunny.ply --output bunny.png
  penumbra render scene.json --max-error 0.002 --output fine.png
  penumbra render scene.json --method reference --samples 1024 --size 1280x960 --output r.exr
  penumbra render scene.json --output s.exr --output s.png --stats s.json
  penumbra render scene.json --output - | display
Lengths are scene units, times in --stats milliseconds, visibility the fraction of the disk seen (0 to 1).)";

struct Arguments {
  CommonOptions common;
  SceneInput scene;
  std::string method = kMethodOfRender, size = "640x480", probe;
  PictureOptions picture;
  std::vector<std::filesystem::path> images;
  std::filesystem::path stats, plan;
  double exposure = 0.0;
  int warm_up = 0;
  OptionValues options;

  std::vector<Output> outputs() const {
    std::vector<Output> all;
    for (const auto& image : images) all.push_back({"--output", image});
    all.push_back({"--stats", stats});
    return all;
  }
};

// Everything that can be refused without reading the scene.
RenderOptions checked_options(const Arguments& arguments) {
  RenderOptions options;
  options.method = method_named(arguments.method).name;
  options.options = arguments.options;
  const PixelPair size = parse_size(arguments.size);
  options.width = size.x;
  options.height = size.y;
  if (arguments.images.empty() && arguments.stats.empty() && arguments.probe.empty())
    throw UsageError("nothing to do; give --output image.png, --stats or --probe");
  std::vector<std::filesystem::path> destinations = arguments.images;
  destinations.push_back(arguments.stats);
  if (!arguments.probe.empty()) {
    parse_pixel(arguments.probe, size);
    destinations.push_back("-");
  }
  require_one_stdout(destinations);
  for (const auto& output : arguments.images) require_extension("--output", output, {".png", ".exr"}, true);
  for (const auto& destination : destinations) require_writable(destination);
  require_apart(arguments.outputs(), {arguments.scene.path, arguments.plan});
  return options;
}

/// One line for each option that was given and has no effect.
void say_what_is_ignored(const Arguments& arguments) {
  const MethodInfo& method = method_named(arguments.method);
  for (const auto& [name, value] : arguments.options)
    if (std::ranges::find(method.options, name, &OptionSchema::name) == method.options.end())
      say_ignored("--" + name,
                  "method " + method.name + " has no such option (" + methods_with(name) + " only)");
  const auto is_png = [](const std::filesystem::path& path) { return extension_of(path) != ".exr"; };
  if (arguments.exposure != 0.0 && std::ranges::none_of(arguments.images, is_png))
    say_ignored("--exposure", "no PNG is written");
  if (arguments.picture.background && std::ranges::none_of(arguments.images, is_png))
    say_ignored("--background", "no PNG is written; an EXR has alpha");
  if (arguments.warm_up > 0 && arguments.stats.empty() && !arguments.common.verbose)
    say_ignored("--warm-up", "times are in --stats and --verbose");
}

void write_image(const std::filesystem::path& path, const Image& image, const Display& display) {
  constexpr std::int64_t kMany = 2'000'000;  // pixels that take a second or more
  ProgressLine progress("writing " + path.string());
  if (std::int64_t{image.width} * image.height > kMany) progress.begin();
  if (extension_of(path) == ".exr")
    write_exr(path, image);
  else
    write_png(path, image, display);
}

/// Whether it takes a second or more until the first pixel, in which nothing tells how far it is.
bool takes_a_while(const Scene& scene) {
  constexpr std::size_t kMany = 500'000;  // faces
  std::size_t faces = 0;
  for (const SceneObject& object : scene.objects) faces += object.mesh.triangles().size();
  return faces > kMany;
}

void say_stages(const RenderResult& result) {
  for (const StageTime& stage : result.stages) {
    char line[128];
    std::snprintf(line, sizeof line, "%-24s %9.2f ms", stage.name.c_str(), stage.milliseconds);
    complain(line);
  }
  char line[64];
  std::snprintf(line, sizeof line, "%-24s %9.2f ms", "frame", result.frame_ms);
  complain(line);
}

/// Of the method auto: one line for each light for which, by its model, no method keeps what was asked for.
void say_what_is_not_kept(const RenderResult& result) {
  for (const MethodFrame& light : result.lights)
    for (const Decision& each : light.decisions)
      if (each.reason == "most-accurate" || each.reason == "within-time" || each.reason == "fastest")
        complain("warning: light " + light.light + ": " + each.choice + ", since " + each.text);
}

void run(const Arguments& arguments) {
  RenderOptions options = checked_options(arguments);
  const ThreadLimit limit(arguments.common.threads);
  say_what_is_ignored(arguments);
  Scene scene = load(arguments.scene);
  apply(arguments.picture, scene);
  require_apart(arguments.outputs(), scene.files);
  options.antialias = scene.picture.antialias;
  options.leave_out_dark = true;
  if (!arguments.plan.empty()) options.method = method_of_plans(arguments.plan, scene);
  RenderResult result;
  {
    ProgressLine progress("rendering");
    if (takes_a_while(scene)) progress.begin();
    options.progress = progress.callback();
    result = render(scene, options, arguments.common.threads, arguments.warm_up);
  }
  if (std::ranges::all_of(result.surface.object, [](std::int32_t object) { return object < 0; }))
    complain("warning: the camera sees no surface; the image is empty");
  for (const std::string& warning : result.warnings) complain("warning: " + warning);
  say_what_is_not_kept(result);
  if (arguments.common.verbose) say_stages(result);
  // An EXR has the channels of all lights; to fill them is no part of the frame.
  if (!arguments.probe.empty() ||
      std::ranges::any_of(arguments.images, [](const auto& path) { return extension_of(path) == ".exr"; }))
    add_dark_channels(scene, result, arguments.common.threads);
  result.image.metadata = metadata_of(scene, arguments.scene.path.string(), result);
  const Display display{arguments.exposure, scene.picture.background};
  for (const auto& output : arguments.images) {
    write_image(output, result.image, display);
    say_written(arguments.common.verbose, output);
  }
  if (!arguments.stats.empty()) {
    write_json(arguments.stats, stats_of(result, used_threads(arguments.common.threads)));
    say_written(arguments.common.verbose, arguments.stats);
  }
  if (!arguments.probe.empty())
    print(to_text(probe_pixel(scene, result, arguments.common.threads,
                              parse_pixel(arguments.probe, {options.width, options.height}))));
}

}  // namespace

void add_render_command(CLI::App& app) {
  CLI::App& command =
      *app.add_subcommand("render", "An image of a scene's soft shadow, by one of several methods");
  auto arguments = std::make_shared<Arguments>();

  add_scene_input(command, arguments->scene);
  command.add_option("-m,--method", arguments->method, "How visibility is computed: " + method_words())
      ->capture_default_str();
  command
      .add_option(
          "-o,--output", arguments->images,
          "Image to write, PNG (sRGB) or EXR (all channels) by extension; - is PNG on standard output; "
          "may be repeated")
      ->allow_extra_args(false)  // one file each time
      ->type_name("FILE");
  command.add_option("--size", arguments->size, "Pixels, WIDTHxHEIGHT")
      ->capture_default_str()
      ->type_name("WxH");
  add_exposure_option(command, arguments->exposure, "Stops by which a PNG is brighter; no effect on EXR");
  add_picture_options(command, arguments->picture);
  command
      .add_option("--stats", arguments->stats,
                  "Write method, options, stage times and counts as JSON; - is standard output")
      ->type_name("FILE");
  command
      .add_option("--probe", arguments->probe,
                  "Print what is at this pixel as JSON, with 4,096 reference rays; 0,0 is the top left")
      ->type_name("X,Y");
  command
      .add_option("--plan", arguments->plan,
                  "Do what this file of penumbra plan --output says, in place of --method")
      ->type_name("FILE");
  command.add_option("--warm-up", arguments->warm_up, "Frames rendered and thrown away before the timed one")
      ->check(CLI::Range(0, 1000))
      ->capture_default_str();
  add_method_options(command, arguments->options);
  add_effect_option(command, arguments->options);
  add_common_options(command, arguments->common);
  command.footer(kFooter);
  command.callback([arguments] { run(*arguments); });
}

}  // namespace penumbra::apps
