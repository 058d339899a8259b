// penumbra plan: what the method auto would do for a scene, and why.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <set>
#include <string_view>
#include <utility>

#include "apps/cli/commands.h"
#include "apps/common/options.h"
#include "apps/common/outputs.h"
#include "apps/common/stats.h"
#include "penumbra/render/plan/plan.h"
#include "penumbra/render/renderer.h"

namespace penumbra::apps {
namespace {

constexpr const char* kFooter = R"(Examples:
  penumbra plan scene.json
  penumbra plan scene.json --max-error 0.003 --json
A certificate is a proof that the picture is the same without what is left out. Times are a model's, for the machine of
docs/plan.md; only their ratios matter here.)";

constexpr std::string_view kCaster = "caster ";

struct Arguments {
  CommonOptions common;
  SceneInput scene;
  std::string size = "640x480";
  PlanRequest request;
  bool json = false;
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
  option_named("plan-frames").require_allowed(static_cast<std::uint64_t>(std::max(0, request.frames)));
}

nlohmann::json to_json(const SampledPart& part) {
  return {{"share", part.share},
          {"edges", part.edges},
          {"merged_edges", part.merged_edges},
          {"edge_length", part.edge_length},
          {"boxes", part.boxes}};
}

nlohmann::json to_json(const LightFacts& facts) {
  std::size_t faces = 0, edges = 0;
  for (const CasterFacts& caster : facts.casters) {
    if (caster.reach != CasterReach::kMayReach) continue;
    faces += caster.faces;
    edges += caster.edges;
  }
  return {{"receivers", facts.receivers},
          {"dark_receivers", facts.dark},
          {"casters", facts.casters.size()},
          {"faces", faces},
          {"edges", edges},
          {"sampled_receivers", facts.sampled.receivers},
          {"variance", facts.sampled.variance},
          {"boundary", facts.sampled.boundary},
          {"lit", to_json(facts.sampled.lit)},
          {"penumbra", to_json(facts.sampled.penumbra)},
          {"hidden", to_json(facts.sampled.hidden)}};
}

nlohmann::json to_json(const Light& light, const LightPlan& plan) {
  return {{"light", light.name},
          {"facts", to_json(plan.facts)},
          {"method", plan.method},
          {"options", apps::to_json(plan.options)},
          {"predicted_ms", plan.milliseconds},
          {"predicted_error", plan.error},
          {"decisions", apps::to_json(plan.decisions)}};
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

void run(const Arguments& arguments) {
  const PixelPair size = parse_size(arguments.size);
  require_allowed(arguments.request);
  const ThreadLimit limit(arguments.common.threads);
  Renderer renderer(load(arguments.scene), arguments.common.threads);
  const std::vector<LightPlan> plans = renderer.plan(arguments.request, size.x, size.y);
  nlohmann::json json = nlohmann::json::array();
  std::string text;
  for (std::size_t k = 0; k < plans.size(); ++k) {
    const Light& light = renderer.scene().lights[k];
    json.push_back(to_json(light, plans[k]));
    text += to_text(light, k, plans[k]);
  }
  print(arguments.json ? apps::to_text(nlohmann::json{{"lights", json}}) : text);
}

}  // namespace

void add_plan_command(CLI::App& app) {
  CLI::App& command =
      *app.add_subcommand("plan", "What the method auto would do for each light of a scene, and why");
  auto arguments = std::make_shared<Arguments>();
  add_scene_input(command, arguments->scene);
  add_option_of_auto(command, "max-error", arguments->request.max_error);
  add_option_of_auto(command, "max-ms", arguments->request.max_ms);
  add_option_of_auto(command, "hard-below", arguments->request.hard_below);
  add_option_of_auto(command, "plan-frames", arguments->request.frames);
  command.add_option("--size", arguments->size, "Pixels of the picture, WIDTHxHEIGHT")
      ->capture_default_str()
      ->type_name("WxH");
  command.add_flag("--json", arguments->json, "Print JSON");
  add_common_options(command, arguments->common);
  command.footer(kFooter);
  command.callback([arguments] { run(*arguments); });
}

}  // namespace penumbra::apps
