// penumbra compare: how wrong an image is, against another image or against rays traced from its scene.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <span>
#include <vector>

#include "apps/cli/commands.h"
#include "apps/cli/compare/compare_picture.h"
#include "apps/cli/compare/comparison.h"
#include "apps/cli/made_by.h"
#include "apps/common/messages.h"
#include "apps/common/options.h"
#include "apps/common/outputs.h"
#include "apps/common/parse_errors.h"
#include "penumbra/mesh/error.h"

namespace penumbra::apps {
namespace {

constexpr const char* kFooter = R"(Examples:
  penumbra compare dbuffer.exr scene.json
  penumbra compare dbuffer.exr reference.exr --picture difference.png
  penumbra compare dbuffer.exr scene.json --object 0 --json
Errors are of visibility, the fraction of the disk seen. Against a scene two independent references are traced and the
noise they have is taken out of the RMSE; the worst 2% of penumbra pixels (at least 1,000) are sampled again with 65,536
rays before p99 and maximum are stated; where p99 is 25 times the noise or more only the worst 20. Against an image that
image is taken as it is. The interval is a 95% bootstrap over pixels. --judge double shares nothing with the methods, its
camera included. It looks at some pixels, samples the worst 300 again with 32,768 rays, and counts certificates (channel
region) that its rays contradict.)";

struct Arguments {
  CommonOptions common;
  SceneInput scene;
  std::filesystem::path image, beside, picture, signed_difference;
  TraceOptions trace;
  std::string judge = "rays";
  std::size_t judge_pixels = 20'000;
  Judged judged;
  bool json = false;
  double exposure = 0.0;

  std::vector<Output> outputs() const {
    return {{"--picture", picture}, {"--signed-difference", signed_difference}};
  }
  bool wants_pictures() const { return !picture.empty() || !signed_difference.empty(); }
  bool against_image() const { return extension_of(scene.path) == ".exr"; }
};

void check(const Arguments& arguments) {
  if (arguments.judge == "double" && arguments.against_image())
    throw UsageError("--judge double needs the scene as B; an image is taken as it is");
  require_extension("A", arguments.image, {".exr"}, false);
  if (!arguments.beside.empty()) require_extension("--beside", arguments.beside, {".exr"}, false);
  for (const auto& [option, path] : arguments.outputs()) {
    if (path.empty()) continue;
    require_extension(option, path, {".png"}, false);  // figures go to standard output
    require_writable(path);
  }
  require_apart(arguments.outputs(), {arguments.image, arguments.scene.path, arguments.beside});
}

/// One line for each option that was given and has no effect.
void say_what_is_ignored(const Arguments& arguments, const CLI::App& command) {
  const auto given = [&command](const char* option) { return command.count(option) > 0; };
  if (arguments.against_image())
    for (const char* option : {"--samples", "--judge", "--strict"})
      if (given(option)) say_ignored(option, "B is an image, which is taken as it is");
  if (given("--judge-pixels") && arguments.judge != "double")
    say_ignored("--judge-pixels", "only --judge double chooses pixels");
  if (arguments.picture.empty())
    for (const char* option : {"--beside", "--exposure"})
      if (given(option)) say_ignored(option, "there is no --picture");
}

nlohmann::json to_json(const ErrorFigures& figures) {
  return {{"pixels", figures.pixels},
          {"rmse", figures.rmse},
          {"rmse_low", figures.rmse_low},
          {"rmse_high", figures.rmse_high},
          {"mse", figures.mse},
          {"mean", figures.mean},
          {"mean_absolute", figures.mean_absolute},
          {"median_absolute", figures.median_absolute},
          {"p99_absolute", figures.p99_absolute},
          {"max_absolute", figures.max_absolute}};
}

/// What made A, and B where it is an image.
struct Makers {
  Metadata image;
  std::optional<Metadata> reference;
};

/// What the table begins with.
std::string heading(const Arguments& arguments, const Makers& makers) {
  std::string text = "A " + arguments.image.string() + ": " + made_by(makers.image) + "\n";
  text += "B " + arguments.scene.path.string();
  return text + (makers.reference ? ": " + made_by(*makers.reference) : "") + "\n";
}

nlohmann::json to_json(const Arguments& arguments, const Makers& makers, const Comparison& comparison) {
  nlohmann::json report = {
      {"image", arguments.image.string()},    {"reference", arguments.scene.path.string()},
      {"all", to_json(comparison.all)},       {"penumbra", to_json(comparison.in_penumbra)},
      {"skipped_pixels", comparison.skipped}, {"difference_scale", difference_scale(comparison)}};
  report["image_made_by"] = made_by_json(makers.image);
  if (makers.reference) report["reference_made_by"] = made_by_json(*makers.reference);
  if (arguments.judged.object) report["object"] = *arguments.judged.object;
  if (!arguments.judged.light.empty()) report["light"] = arguments.judged.light;
  if (comparison.samples == 0) return report;
  report["judge"] = arguments.judge;
  report["samples"] = comparison.samples;
  report["resampled_pixels"] = comparison.resampled;
  report["resamples"] = comparison.resamples;
  if (comparison.certified > 0) {
    report["certified_pixels"] = comparison.certified;
    report["contradicted_pixels"] = comparison.contradicted;
  }
  report["rays"] = comparison.rays;
  report["seconds"] = comparison.seconds;
  report["mrays_per_second"] = 1e-6 * static_cast<double>(comparison.rays) / comparison.seconds;
  return report;
}

std::string table_row(const char* name, const ErrorFigures& figures) {
  char row[256];
  std::snprintf(row, sizeof row, "%-14s %9zu  %.5f  [%.5f, %.5f]  %+.5f  %.5f  %.5f  %.5f  %.5f\n", name,
                figures.pixels, figures.rmse, figures.rmse_low, figures.rmse_high, figures.mean,
                figures.mean_absolute, figures.median_absolute, figures.p99_absolute, figures.max_absolute);
  return row;
}

std::string to_table(const Comparison& comparison) {
  std::string text =
      "                  pixels     RMSE      95% interval          mean   |mean|   median      p99      "
      "max\n";
  text += table_row("all receivers", comparison.all) + table_row("true penumbra", comparison.in_penumbra);
  char line[256];
  if (comparison.samples > 0) {
    text += "two references of " + std::to_string(comparison.samples) + " samples; ";
    if (comparison.resampled > 0)
      text += "worst " + std::to_string(comparison.resampled) + " pixels again at " +
              std::to_string(comparison.resamples) + "; ";
    std::snprintf(line, sizeof line, "%.1f s, %.3g million rays a second\n", comparison.seconds,
                  1e-6 * static_cast<double>(comparison.rays) / comparison.seconds);
    text += line;
  }
  if (comparison.certified > 0) {
    std::snprintf(line, sizeof line,
                  "%zu of these pixels are certified lit or in umbra; rays contradict %zu\n",
                  comparison.certified, comparison.contradicted);
    text += line;
  }
  if (comparison.skipped > 0) {
    std::snprintf(line, sizeof line, "%zu pixels left out: their surfaces differ\n", comparison.skipped);
    text += line;
  }
  return text;
}

std::string scale_line(double scale) {
  char line[128];
  std::snprintf(line, sizeof line, "the signed difference is blue at %+g and below, red at %+g and above\n",
                -scale, scale);
  return line;
}

void write_pictures(const Arguments& arguments, std::span<const JudgedImage> images, const Image* reference) {
  const auto write = [&](const std::filesystem::path& path, const Picture& picture) {
    write_png(path, picture.width(), picture.height(), picture.rgb());
    say_written(arguments.common.verbose, path);
  };
  if (!arguments.signed_difference.empty())
    write(arguments.signed_difference,
          difference_picture(images.front(), difference_scale(images.front().comparison)));
  if (!arguments.picture.empty())
    write(arguments.picture,
          side_by_side(images, reference, arguments.scene.path.stem().string(), arguments.exposure));
}

void run(const Arguments& arguments) {
  const ThreadLimit limit(arguments.common.threads);
  std::optional<Image> reference;
  std::optional<Scene> scene;
  std::optional<SceneComparison> to_scene;
  if (arguments.against_image()) {
    reference = read_exr(arguments.scene.path);
  } else {
    scene = load(arguments.scene);
    require_apart(arguments.outputs(), scene->files);
    to_scene.emplace(*scene, arguments.judged, arguments.trace);
  }
  const auto compare = [&](const Image& image) {
    return reference ? compare_images(image, *reference, arguments.judged) : to_scene->compare(image);
  };
  const auto judged = [&](const std::filesystem::path& path, const Image& image,
                          const Comparison& comparison) {
    return JudgedImage{image, path.stem().string(), arguments.judged.channel(), comparison};
  };
  const Image image = read_exr(arguments.image);
  Makers makers{.image = image.metadata, .reference = {}};
  if (reference) makers.reference = reference->metadata;
  for (const std::string& name :
       differences(image.metadata, reference ? reference->metadata : metadata_of(*scene)))
    complain("warning: A and B differ in " + name + "; figures may judge that");
  const Comparison comparison = compare(image);
  std::string text = arguments.json ? to_text(to_json(arguments, makers, comparison))
                                    : heading(arguments, makers) + to_table(comparison);
  if (!arguments.json && arguments.wants_pictures()) text += scale_line(difference_scale(comparison));
  print(text);
  std::vector<JudgedImage> images{judged(arguments.image, image, comparison)};
  Image beside;
  Comparison beside_comparison;
  if (!arguments.beside.empty()) {
    beside = read_exr(arguments.beside);
    beside_comparison = compare(beside);
    images.push_back(judged(arguments.beside, beside, beside_comparison));
  }
  write_pictures(arguments, images, reference ? &*reference : nullptr);
}

}  // namespace

void add_compare_command(CLI::App& app) {
  CLI::App& command =
      *app.add_subcommand("compare", "Error figures of an image against another image or its scene");
  auto arguments = std::make_shared<Arguments>();
  command.add_option("A", arguments->image, "Image to judge: an EXR written by penumbra render")->required();
  command
      .add_option("B", arguments->scene.path, "What is right: an EXR, or the scene that A was rendered from")
      ->required();
  CLI::Option* samples =
      command.add_option("--samples", arguments->trace.samples, "Rays a pixel of each of the two references")
          ->check(CLI::Range(16, 1 << 20))
          ->capture_default_str();
  command
      .add_option("--judge", arguments->judge,
                  "What traces the references: rays (Embree), or double (shares nothing with the methods; "
                  "at some pixels, 1,024 rays each unless --samples says otherwise)")
      ->check([](const std::string& word) {
        return require_one_of({"rays", "double"}, word);
      })
      ->capture_default_str();
  command
      .add_option("--judge-pixels", arguments->judge_pixels,
                  "Pixels at which --judge double looks, chosen by chance")
      ->check(CLI::Range(std::size_t{1}, std::size_t{1} << 32))
      ->capture_default_str();
  command
      .add_option("--light", arguments->judged.light,
                  "Judge this light's visibility, where the scene has several")
      ->type_name("NAME");
  command
      .add_option("--object", arguments->judged.object,
                  "Judge only pixels of this object (index in the scene)")
      ->check(CLI::NonNegativeNumber);
  command.add_flag("--json", arguments->json, "Print JSON");
  command
      .add_option("--picture", arguments->picture,
                  "Write A, B and their signed difference side by side (PNG)")
      ->type_name("FILE");
  command
      .add_option("--signed-difference", arguments->signed_difference,
                  "Write visibility of A minus B (PNG): blue too dark, red too bright")
      ->type_name("FILE");
  command
      .add_option("--beside", arguments->beside,
                  "Another image (EXR) of the same size: --picture shows it and its difference to B as well")
      ->type_name("FILE");
  add_exposure_option(command, arguments->exposure, "Stops by which the images in --picture are brighter");
  add_strict_option(command, arguments->scene);
  add_common_options(command, arguments->common);
  command.footer(kFooter);
  command.callback([arguments, samples, &command] {
    check(*arguments);
    say_what_is_ignored(*arguments, command);
    if (arguments->judge == "double") {
      arguments->trace.oracle_pixels = arguments->judge_pixels;
      if (samples->empty()) arguments->trace.samples = 1'024;
    }
    run(*arguments);
  });
}

}  // namespace penumbra::apps
