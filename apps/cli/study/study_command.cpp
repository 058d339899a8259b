// penumbra study: what accuracy costs in time, as numbers and as one page.
#include <CLI/CLI.hpp>
#include <algorithm>

#include "apps/cli/commands.h"
#include "apps/cli/ranks/shared_work.h"
#include "apps/cli/study/peers/embree_loop.h"
#include "apps/cli/study/peers/peer.h"
#include "apps/cli/study/pictures/study_pictures.h"
#include "apps/cli/study/study.h"
#include "apps/common/messages.h"
#include "apps/common/options.h"
#include "apps/common/outputs.h"
#include "penumbra/mesh/error.h"

namespace penumbra::apps {
namespace {

constexpr const char* kFooter = R"(Examples:
  penumbra study data/scenes/bunny-medium.json data/scenes/cube-medium.json --output study
  penumbra study scene.json --output study --quick
  penumbra study scene.json --output study --methods silhouette,rays
Every method is timed and judged with its defaults, and with all combinations of its options where these are at most 16;
else with each option varied alone. DIR gets rows.jsonl, to which rows are added as they finish, study.csv, study.json,
pictures/ and index.html, one page that needs no network. A second call measures what is missing. Times are milliseconds, errors are of the fraction of the light that is seen.)";

// Errors at such a size and with so few rays are for a first look.
constexpr StudyView kQuickView{.width = 320, .height = 240};
constexpr int kQuickSamples = 1'024, kQuickDoubleSamples = 256;
constexpr std::size_t kQuickDoublePixels = 300;

struct Arguments {
  CommonOptions common;
  StudyOptions study;
  std::string size;
};

/// Once a process. They are methods of this command alone.
void register_peers() {
  static const bool once = (register_method(embree_loop()), true);
  static_cast<void>(once);
}

void require_scenes(const StudyOptions& study) {
  for (std::size_t i = 0; i < study.scenes.size(); ++i) {
    if (is_standard(study.scenes[i])) throw UsageError("a study needs scenes as files, not standard input");
    for (std::size_t k = 0; k < i; ++k)
      if (file_name_of(study.scenes[k].stem().string()) == file_name_of(study.scenes[i].stem().string()))
        throw UsageError("two scenes are called " + study.scenes[k].stem().string() + " and " +
                         study.scenes[i].stem().string() + ", which is one name for pictures; rename one");
  }
}

/// Throws UsageError for what is neither a method nor a peer that is asked for.
void require_methods(const StudyOptions& study) {
  const std::vector<Peer> peers = study.peers ? all_peers(study.three) : std::vector<Peer>{};
  for (const std::string& name : study.methods)
    if (std::ranges::find(peers, name, &Peer::name) == peers.end()) method_named(name);
}

void run(Arguments& arguments, const CLI::App& command) {
  StudyOptions& study = arguments.study;
  if (study.peers) register_peers();
  require_scenes(study);
  require_methods(study);
  if (study.quick) {
    study.view = kQuickView;
    study.memory = false;
    study.judge.resample = false;
    study.judge.double_pixels = kQuickDoublePixels;
    study.judge.double_samples = kQuickDoubleSamples;
    if (command.count("--samples") == 0) study.judge.samples = kQuickSamples;
  }
  if (!arguments.size.empty()) {
    const PixelPair size = parse_size(arguments.size);
    study.view.width = size.x;
    study.view.height = size.y;
  }
  study.judge.threads = arguments.common.threads;
  const ThreadLimit limit(arguments.common.threads);
  const std::unique_ptr<Ranks> ranks = Ranks::of_this_run();
  or_abort_where_lost(ranks.get(), [&] {
    std::optional<std::size_t> measured;
    {
      ProgressLine progress("measuring");
      measured = run_study(study, ranks.get(), progress.callback());
    }
    if (!measured) return;
    print(std::to_string(*measured) + (*measured == 1 ? " row" : " rows") + " measured; the page is " +
          (study.output / "index.html").string() + "\n");
  });
}

}  // namespace

void add_study_command(CLI::App& app) {
  CLI::App& command = *app.add_subcommand("study", "What accuracy costs in time: every method, as one page");
  auto arguments = std::make_shared<Arguments>();
  StudyOptions& study = arguments->study;
  command.add_option("SCENE", study.scenes, "Scene files (*.json) or bare meshes, each with one light")
      ->required();
  command.add_option("-o,--output", study.output, "Folder of the rows, pictures and page; made if missing")
      ->required()
      ->type_name("DIR");
  command.add_flag("--quick", study.quick,
                   "For a first look: 320x240, few settings, 1,024 rays a reference, few pixels in double");
  command.add_option("--methods", study.methods, "Only these methods, divided by commas")
      ->delimiter(',')
      ->type_name("NAMES");
  command.add_option("--size", arguments->size, "Pixels, WIDTHxHEIGHT (default 640x480)")->type_name("WxH");
  command.add_option("--frames", study.rounds, "Timed frames a row")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command
      .add_option("--longest-frame", study.longest_frame_s,
                  "Leave out settings that are dearer than one whose frame took longer; 0: none is left out")
      ->check(CLI::NonNegativeNumber)
      ->type_name("SECONDS")
      ->capture_default_str();
  command.add_option("--samples", study.judge.samples, "Rays a pixel of each of the two references")
      ->check(CLI::Range(16, 1 << 20))
      ->capture_default_str();
  command.add_flag("!--no-memory", study.memory,
                   "Do not measure memory, for which each method's defaults draw a frame alone");
  command.add_flag("--growth", study.growth,
                   "Also how time grows: with light and size of the first scene, with the faces of a sphere");
  command.add_flag(
      "--peers", study.peers,
      "Also what people use instead: a plain loop over Embree's rays, and where they are installed "
      "POV-Ray, Blender's Cycles and three.js");
  command
      .add_option("--three", study.three,
                  "With --peers: the folder of npm's package three, for three.js's soft shadows in Chromium")
      ->type_name("DIR");
  command.add_option("--commit", study.commit, "What the page says of the program's sources")
      ->type_name("TEXT");
  add_common_options(command, arguments->common);
  command.footer(kFooter);
  command.callback([arguments, &command] { run(*arguments, command); });
}

}  // namespace penumbra::apps
