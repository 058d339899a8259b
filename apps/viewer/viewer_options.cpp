#include "apps/viewer/viewer_options.h"

#include <CLI/CLI.hpp>
#include <iostream>

#include "apps/common/failures.h"
#include "apps/common/method_options.h"
#include "apps/common/options.h"
#include "apps/common/outputs.h"
#include "apps/common/parse_errors.h"
#include "apps/viewer/show.h"
#include "penumbra/mesh/error.h"

namespace penumbra::viewer {
namespace {

constexpr const char* kDescription =
    "penumbra-viewer: soft shadows of a disk light that is moved, tilted and resized by hand.";

constexpr const char* kFooter = R"(A SCENE is a scene file (*.json) or a bare mesh (OBJ, PLY, OFF, STL).

Examples:
  penumbra-viewer
  penumbra-viewer bunny.ply
  penumbra-viewer scene.json --method reference --samples 64
  xvfb-run penumbra-viewer scene.json --screenshot window.png

H in the window lists the keys. Exit codes: 0 fine, 1 failed (no display, say), 2 bad usage, 3 bad mesh or scene.)";

struct Words {
  std::string size, method = kDefaultMethod, against = "reference", view = "single", shown = "picture";
  std::vector<std::string> overlays;
};

std::string overlay_words() {
  std::string words;
  for (std::size_t i = 0; i < kOverlayFlags.size(); ++i)
    words += (i == 0                          ? ""
              : i + 1 == kOverlayFlags.size() ? " or "
                                              : ", ") +
             std::string(kOverlayFlags[i].first);
  return words;
}

bool& overlay_of(const std::string& word, Overlays& overlays) {
  for (const auto& [name, flag] : kOverlayFlags)
    if (word == name) return overlays.*flag;
  throw UsageError("unknown overlay '" + word + "': use " + overlay_words());
}

Arrangement arrangement_of(const std::string& word) {
  if (word == "single") return Arrangement::kSingle;
  if (word == "split") return Arrangement::kSplit;
  if (word == "difference") return Arrangement::kDifference;
  throw UsageError("unknown view '" + word + "': use single, split or difference");
}

Shown shown_of(const std::string& word) {
  if (word == "picture") return Shown::kPicture;
  if (word == "visibility") return Shown::kVisibility;
  if (word == "certified") return Shown::kRegion;
  throw UsageError("--show '" + word + "': use picture, visibility or certified");
}

void add_options(CLI::App& app, ViewerOptions& options, Words& words) {
  app.add_option("SCENE", options.files,
                 "Scene files or meshes; PgUp and PgDn change between them; none: the window asks for one");
  app.add_option("--size", words.size, "Pixels of the picture, WIDTHxHEIGHT; the panel is beside it")
      ->type_name("WxH");
  app.add_option("-m,--method", words.method, "How visibility is computed: " + apps::method_words())
      ->capture_default_str();
  app.add_option("--view", words.view, "single, split or difference")->capture_default_str();
  app.add_option("--against", words.against, "The second method of split and difference")
      ->capture_default_str();
  apps::add_exposure_option(app, options.state.exposure, "Stops by which the picture is brighter");
  app.add_option("--show", words.shown, "picture, visibility or certified (methods silhouette and rays)")
      ->capture_default_str();
  app.add_flag("--plain", options.plain, "Nothing but the picture: no panel, no handles");
  app.add_option("--overlay", words.overlays, overlay_words() + "; may be repeated")->take_all()->expected(1);
  app.add_option("--font-size", options.font_size,
                 "Pixels of the window's font, which all else follows; 15 at scale 1")
      ->check(CLI::Range(8.0, 64.0))
      ->type_name("PX");
  app.add_flag("--probe", options.state.probe, "Start with the probe");
  app.add_option("--screenshot", options.screenshot,
                 "Write the window as PNG once the picture is final, and leave")
      ->type_name("FILE");
  app.add_option("--frames", options.frames, "Draw the window at least so often before --screenshot")
      ->check(CLI::Range(1, 1'000'000))
      ->capture_default_str();
  app.add_option("--status", options.status, "Keep what the viewer shows in this file as JSON, for scripts")
      ->type_name("FILE");
  app.add_option("--output", options.output, "Folder for what is saved from the window")
      ->type_name("FOLDER")
      ->capture_default_str();
  // For tests, not in --help.
  app.add_option("--random-input", options.random_input)->group("");
  app.add_option("--seconds", options.seconds)->group("");
  app.add_option("--drop", options.drop)->group("");
  apps::add_method_options(app, options.state.left.options);
}

void check(ViewerOptions& options, const Words& words, bool method_given, bool view_given) {
  if (!words.size.empty()) {
    const apps::PixelPair size = apps::parse_size(words.size);
    options.width = size.x;
    options.height = size.y;
  }
  options.state.left.method = method_named(words.method).name;
  options.state.right.method = method_named(words.against).name;
  options.state.arrangement = arrangement_of(words.view);
  options.state.shown = shown_of(words.shown);
  for (const std::string& word : words.overlays) overlay_of(word, options.state.overlays) = true;
  if (method_given) options.method = options.state.left.method;
  if (view_given) options.view = options.state.arrangement;
  if (!options.screenshot.empty()) {
    apps::require_extension("--screenshot", options.screenshot, {".png"}, false);
    apps::require_writable(options.screenshot);
  }
  apps::require_writable(options.status);
  if (options.random_input && options.files.empty()) throw UsageError("--random-input needs a file");
  if (!std::filesystem::is_directory(options.output))
    throw SystemError("--output " + options.output.string() + ": is no folder; create it");
}

int parse_and_run(CLI::App& app, int argc, char** argv) {
  ViewerOptions options;
  Words words;
  add_options(app, options, words);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& e) {  // --help, --version
    app.exit(e, std::cout, std::cerr);
    return apps::kFine;
  } catch (const CLI::ParseError& e) {
    return apps::fail(apps::kBadUsage, apps::explain(app, e, {argv + 1, argv + argc}));
  }
  check(options, words, app.count("--method") > 0, app.count("--view") > 0);
  return show(std::move(options));
}

}  // namespace

int run_viewer(int argc, char** argv) {
  register_drawing_methods();
  CLI::App app(kDescription, "penumbra-viewer");
  app.set_version_flag("--version", "penumbra-viewer " PENUMBRA_VERSION);
  app.footer(kFooter);
  return apps::run_guarded([&] { return parse_and_run(app, argc, argv); });
}

}  // namespace penumbra::viewer
