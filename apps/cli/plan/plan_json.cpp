#include "apps/cli/plan/plan_json.h"

#include <algorithm>
#include <fstream>
#include <string>

#include "apps/common/stats.h"
#include "penumbra/mesh/error.h"
#include "penumbra/render/method.h"
#include "render/plan/auto_method.h"
#include "render/plan/cost_model.h"

namespace penumbra::apps {
namespace {

/// In the order of LightPlan::Action.
constexpr const char* kActions[] = {"nothing", "no shadows", "method"};

nlohmann::json to_json(const SampledPart& part) {
  return {{"share", part.share},
          {"edges", part.edges},
          {"merged_edges", part.merged_edges},
          {"edge_length", part.edge_length},
          {"boxes", part.boxes},
          {"edges_each", part.edges_each}};
}

nlohmann::json to_json(const Light& light, const LightPlan& plan) {
  return {{"light", light.name},
          {"facts", apps::to_json(plan.facts)},
          {"action", kActions[static_cast<int>(plan.action)]},
          {"method", plan.method},
          {"options", apps::to_json(plan.options)},
          {"left_out", plan.left_out},
          {"predicted_ms", plan.milliseconds},
          {"predicted_error", plan.error},
          {"decisions", apps::to_json(plan.decisions)}};
}

[[noreturn]] void refuse(const std::string& what) {
  throw UsageError("plan: " + what + "; write one with penumbra plan --output FILE");
}

LightPlan::Action action_of(const std::string& word) {
  const auto at = std::ranges::find(kActions, word);
  if (at == std::end(kActions)) refuse("no action \"" + word + "\" (nothing, no shadows or method)");
  return static_cast<LightPlan::Action>(at - std::begin(kActions));
}

OptionValues options_of(const nlohmann::json& json, const MethodInfo& method) {
  OptionValues out;
  for (const auto& [name, value] : json.items()) {
    const auto schema = std::ranges::find(method.options, name, &OptionSchema::name);
    if (schema == method.options.end()) refuse("method " + method.name + " has no option " + name);
    out[name] = schema->parse(value.is_string() ? value.get<std::string>() : value.dump());
  }
  return out;
}

LightPlan plan_from_json(const nlohmann::json& json, const Scene& scene) {
  LightPlan plan;
  plan.action = action_of(json.at("action").get<std::string>());
  plan.left_out = json.value("left_out", std::vector<std::size_t>{});
  for (const std::size_t object : plan.left_out)
    if (object >= scene.objects.size()) refuse("the scene has no object " + std::to_string(object));
  std::ranges::sort(plan.left_out);
  plan.milliseconds = json.value("predicted_ms", 0.0);
  plan.error = json.value("predicted_error", 0.0);
  if (plan.action == LightPlan::Action::kMethod) {
    const MethodInfo& method = method_named(json.at("method").get<std::string>());
    plan.method = method.name;
    plan.options = options_of(json.value("options", nlohmann::json::object()), method);
  }
  plan.decisions.push_back({.about = plan.action == LightPlan::Action::kMethod ? "method" : "light",
                            .choice = plan.action == LightPlan::Action::kMethod
                                          ? plan.method
                                          : json.at("action").get<std::string>(),
                            .reason = "plan-given",
                            .text = "the plan that was given says so"});
  return plan;
}

}  // namespace

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
          {"edges_of_method", detail::edges_of_method(facts)},
          {"sampled_receivers", facts.sampled.receivers},
          {"band_edges", facts.sampled.band_edges},
          {"variance", facts.sampled.variance},
          {"boundary", facts.sampled.boundary},
          {"lit", to_json(facts.sampled.lit)},
          {"penumbra", to_json(facts.sampled.penumbra)},
          {"hidden", to_json(facts.sampled.hidden)}};
}

nlohmann::json to_json(std::span<const Light> lights, std::span<const LightPlan> plans) {
  auto out = nlohmann::json::array();
  for (std::size_t k = 0; k < plans.size(); ++k) out.push_back(to_json(lights[k], plans[k]));
  return {{"lights", std::move(out)}};
}

std::vector<LightPlan> plans_from_json(const nlohmann::json& json, const Scene& scene) {
  try {
    const nlohmann::json& lights = json.at("lights");
    if (lights.size() != scene.lights.size())
      refuse("it has " + std::to_string(lights.size()) + " lights, the scene " +
             std::to_string(scene.lights.size()));
    std::vector<LightPlan> plans;
    for (std::size_t k = 0; k < lights.size(); ++k) {
      const auto name = lights[k].at("light").get<std::string>();
      if (name != scene.lights[k].name)
        refuse("its light " + std::to_string(k) + " is called \"" + name + "\", the scene's \"" +
               scene.lights[k].name + "\"");
      plans.push_back(plan_from_json(lights[k], scene));
    }
    return plans;
  } catch (const nlohmann::json::exception& e) {
    refuse(e.what());
  }
}

std::vector<LightPlan> read_plans(const std::filesystem::path& file, const Scene& scene) {
  std::ifstream in(file);
  if (!in)
    throw SystemError(file.string() + ": cannot be read; give a file that penumbra plan --output wrote");
  const auto json = nlohmann::json::parse(in, nullptr, false);
  if (json.is_discarded()) refuse(file.string() + " is no JSON");
  return plans_from_json(json, scene);
}

std::string method_of_plans(const std::filesystem::path& file, const Scene& scene) {
  std::vector<LightShape> lights;
  for (const Light& light : scene.lights) lights.push_back(light.shape);
  MethodInfo method = given_plan_method(std::move(lights), read_plans(file, scene));
  const std::string name = method.name;
  register_method(std::move(method));
  return name;
}

}  // namespace penumbra::apps
