// penumbra plan: what the method auto would do for a scene, and why.
#include <CLI/CLI.hpp>
#include <cstdio>

#include "apps/cli/commands.h"
#include "apps/common/options.h"
#include "apps/common/outputs.h"
#include "apps/common/stats.h"
#include "penumbra/render/renderer.h"

namespace penumbra::apps {
namespace {

constexpr const char* kFooter = R"(Examples:
  penumbra plan scene.json
  penumbra plan scene.json --max-error 0.003 --json
A certificate is a proof that the picture is the same without what is left out. Times are a model's, for the machine of
docs/plan.md; only their ratios matter here.)";

struct Arguments {
  CommonOptions common;
  SceneInput scene;
  std::string size = "640x480";
  double max_error = PlanRequest{}.max_error;
  bool json = false;
};

const OptionSchema& error_option() {
  return method_named("auto").options.front();
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
          {"penumbra", facts.sampled.penumbra},
          {"variance", facts.sampled.variance},
          {"edges_across", facts.sampled.edges},
          {"merged_edges_across", facts.sampled.merged_edges},
          {"boxes", facts.sampled.boxes}};
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

std::string to_text(const Light& light, std::size_t index, const LightPlan& plan) {
  std::string text = "light " + (light.name.empty() ? std::to_string(index) : light.name) + "\n";
  for (const Decision& decision : plan.decisions) text += to_text(decision);
  return text;
}

void run(const Arguments& arguments) {
  const PixelPair size = parse_size(arguments.size);
  error_option().require_allowed(arguments.max_error);
  const ThreadLimit limit(arguments.common.threads);
  Renderer renderer(load(arguments.scene), arguments.common.threads);
  const std::vector<LightPlan> plans = renderer.plan({.max_error = arguments.max_error}, size.x, size.y);
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
  command
      .add_option("--max-error", arguments->max_error,
                  error_option().help + " (" + error_option().allowed() + ")")
      ->capture_default_str();
  command.add_option("--size", arguments->size, "Pixels of the picture, WIDTHxHEIGHT")
      ->capture_default_str()
      ->type_name("WxH");
  command.add_flag("--json", arguments->json, "Print JSON");
  add_common_options(command, arguments->common);
  command.footer(kFooter);
  command.callback([arguments] { run(*arguments); });
}

}  // namespace penumbra::apps
