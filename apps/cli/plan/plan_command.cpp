// penumbra plan: what the method auto would do for a scene, and why.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <set>
#include <string_view>
#include <utility>

#include "apps/cli/commands.h"
#include "apps/cli/plan/calibration.h"
#include "apps/cli/plan/effect_option.h"
#include "apps/cli/plan/plan_json.h"
#include "apps/cli/plan/plan_picture.h"
#include "apps/common/messages.h"
#include "apps/common/options.h"
#include "apps/common/outputs.h"
#include "penumbra/mesh/error.h"
#include "penumbra/render/plan/plan.h"
#include "penumbra/render/renderer.h"

namespace penumbra::apps {
namespace {

constexpr const char* kFooter = R"(Examples:
  penumbra plan scene.json
  penumbra plan scene.json --max-error 0.003 --json
  penumbra plan scene.json --output plan.json
A certificate is a proof that the picture is the same without what is left out. Times are a model's, for the machine of
docs/plan.md; only their ratios matter here.)";

constexpr std::string_view kCaster = "caster ";

struct Arguments {
  CommonOptions common;
  SceneInput scene;
  std::string size = "640x480";
  PlanRequest request;
  std::filesystem::path output, picture;
  std::string light;
  bool json = false, calibrate = false;
};

const OptionSchema& option_named(const std::string& name) {
  const std::vector<OptionSchema>& options = method_named("auto").options;
  return *std::ranges::find(options, name, &OptionSchema::name);
}

/// An option of the method auto.
template <class T>
void add_option_of_auto(CLI::App& command, const std::string& name, T& value) {
  const OptionSchema& option = option_named(name);
  command.add_option("--" + name, value, option.help + " (" + option.allowed() + ")")->capture_default_str();
}

/// Throws UsageError for what the method auto would not take.
void require_allowed(const PlanRequest& request) {
  option_named("max-error").require_allowed(request.max_error);
  option_named("max-ms").require_allowed(request.max_ms);
  option_named("hard-below").require_allowed(request.hard_below);
  option_named("plan-speed").require_allowed(request.speed);
  option_named("plan-frames").require_allowed(static_cast<std::uint64_t>(std::max(0, request.frames)));
}

std::string to_text(const Decision& decision) {
  std::string text = "  " + decision.about + ": " + decision.choice + ", since " + decision.text + " [" +
                     decision.reason + (decision.is_certificate ? ", certificate]\n" : "]\n");
  std::string numbers;
  for (const DecisionNumber& number : decision.numbers) {
    char value[64];
    std::snprintf(value, sizeof value, "%s %.4g", number.name.c_str(), number.value);
    numbers += (numbers.empty() ? "    " : ", ") + std::string(value);
  }
  return text + (numbers.empty() ? "" : numbers + "\n");
}

/// Casters of one choice and reason, in one line.
std::string casters_to_text(const std::vector<Decision>& decisions, const Decision& first) {
  std::string names;
  double faces = 0.0;
  std::size_t count = 0;
  for (const Decision& each : decisions) {
    if (each.choice != first.choice || each.reason != first.reason) continue;
    names += (count++ ? ", " : "") + each.about.substr(kCaster.size());
    for (const DecisionNumber& number : each.numbers) faces += number.name == "faces" ? number.value : 0.0;
  }
  char line[64];
  std::snprintf(line, sizeof line, "  %zu caster%s of %.0f faces: ", count, count == 1 ? "" : "s", faces);
  return line + first.choice + ", since " + first.text + " [" + first.reason + ", certificate]\n    " +
         names + "\n";
}

std::string to_text(const Light& light, std::size_t index, const LightPlan& plan) {
  std::string text = "light " + (light.name.empty() ? std::to_string(index) : light.name) + "\n";
  std::set<std::pair<std::string, std::string>> said;
  for (const Decision& decision : plan.decisions) {
    if (!decision.about.starts_with(kCaster))
      text += to_text(decision);
    else if (said.insert({decision.choice, decision.reason}).second)
      text += casters_to_text(plan.decisions, decision);
  }
  return text;
}

/// What is assumed of the machine, where times matter.
std::string assumption(const PlanRequest& request) {
  char text[160];
  std::snprintf(text, sizeof text,
                "times: assumed is a machine %.3g times as fast as the model's (--plan-speed)\n",
                request.speed);
  return request.max_ms > 0.0 ? text : "";
}

void run_calibration(const Arguments& arguments) {
  const Calibration found = calibrate(arguments.common.threads);
  if (arguments.json)
    return print(apps::to_text(nlohmann::json{{"silhouette_ms", found.silhouette_ms},
                                              {"reference_ms", found.reference_ms},
                                              {"speed", found.speed}}));
  char text[200];
  std::snprintf(text, sizeof text,
                "silhouette %.1f ms, reference %.1f ms: %.2f times as fast as the model's machine; give "
                "--plan-speed %.2f with --max-ms\n",
                found.silhouette_ms, found.reference_ms, found.speed, found.speed);
  print(text);
}

/// Returns what the colors of the picture stand for.
std::string draw(const Arguments& arguments, const Scene& scene, const std::vector<LightPlan>& plans,
                 PixelPair size) {
  const std::size_t k = arguments.light.empty() ? 0 : scene.light_index(arguments.light);
  const std::vector<Done> done =
      done_by(scene, scene.lights[k].shape, plans[k], size.x, size.y, arguments.common.threads);
  write_done(arguments.picture, size.x, size.y, done);
  say_written(arguments.common.verbose, arguments.picture);
  return shares_of(done);
}

void require_good_outputs(const Arguments& arguments) {
  if (!arguments.picture.empty()) require_extension("--picture", arguments.picture, {".png"}, false);
  if (!arguments.light.empty() && arguments.picture.empty()) say_ignored("--light", "there is no --picture");
  if (!arguments.output.empty()) require_extension("--output", arguments.output, {".json"}, true);
  require_one_stdout({arguments.output, arguments.json ? "-" : ""});
  for (const auto& path : {arguments.output, arguments.picture}) require_writable(path);
  require_apart({{"--output", arguments.output}, {"--picture", arguments.picture}}, {arguments.scene.path});
}

void run(const Arguments& arguments) {
  if (arguments.calibrate) return run_calibration(arguments);
  if (arguments.scene.path.empty()) throw UsageError("plan of what? give a scene, or --calibrate");
  const PixelPair size = parse_size(arguments.size);
  require_allowed(arguments.request);
  require_good_outputs(arguments);
  const ThreadLimit limit(arguments.common.threads);
  Renderer renderer(load(arguments.scene), arguments.common.threads);
  const std::vector<LightPlan> plans = renderer.plan(arguments.request, size.x, size.y);
  const std::vector<Light>& lights = renderer.scene().lights;
  if (!arguments.output.empty()) write_json(arguments.output, to_json(lights, plans));
  const std::string shares = arguments.picture.empty() ? "" : draw(arguments, renderer.scene(), plans, size);
  if (is_standard(arguments.output)) return;
  if (arguments.json) return print(apps::to_text(to_json(lights, plans)));
  std::string text = assumption(arguments.request);
  for (std::size_t k = 0; k < plans.size(); ++k) text += to_text(lights[k], k, plans[k]);
  print(text + shares);
}

}  // namespace

void add_plan_command(CLI::App& app) {
  CLI::App& command =
      *app.add_subcommand("plan", "What the method auto would do for each light of a scene, and why");
  auto arguments = std::make_shared<Arguments>();
  add_scene_input(command, arguments->scene);
  command.get_option("SCENE")->required(false);
  add_option_of_auto(command, "max-error", arguments->request.max_error);
  add_option_of_auto(command, "max-ms", arguments->request.max_ms);
  add_option_of_auto(command, "hard-below", arguments->request.hard_below);
  add_option_of_auto(command, "plan-frames", arguments->request.frames);
  add_option_of_auto(command, "plan-speed", arguments->request.speed);
  add_effect_option(command, arguments->request.effects);
  command.add_flag("--calibrate", arguments->calibrate,
                   "Measure how fast this machine is, for --plan-speed; needs no scene, takes a second");
  command.add_option("--size", arguments->size, "Pixels of the picture, WIDTHxHEIGHT")
      ->capture_default_str()
      ->type_name("WxH");
  command
      .add_option("--output", arguments->output,
                  "Write the plan as JSON: penumbra render --plan FILE does what it says")
      ->type_name("FILE");
  command
      .add_option("--picture", arguments->picture,
                  "Draw what is done for each pixel: certificates, areas, rays (PNG)")
      ->type_name("FILE");
  command.add_option("--light", arguments->light, "The light of --picture; the first unless it is given")
      ->type_name("NAME");
  command.add_flag("--json", arguments->json, "Print JSON");
  add_common_options(command, arguments->common);
  command.footer(kFooter);
  command.callback([arguments] { run(*arguments); });
}

}  // namespace penumbra::apps
