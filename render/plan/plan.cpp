#include "penumbra/render/plan/plan.h"

#include <algorithm>
#include <cstdio>

#include "penumbra/mesh/error.h"
#include "render/plan/cost_model.h"

namespace penumbra {
namespace {

using namespace detail;

/// A method that may be run, by the model.
struct Candidate {
  std::string method;
  OptionValues options;
  double milliseconds, error;
};

std::string shown(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

std::string name_of(const CasterFacts& caster) {
  return "caster " + std::to_string(caster.object) + (caster.name.empty() ? "" : " (" + caster.name + ")");
}

Decision why_left_out(const CasterFacts& caster) {
  const bool behind = caster.reach == CasterReach::kBehindLight;
  return {.about = name_of(caster),
          .choice = "left out",
          .reason = behind ? "behind-light" : "misses-receivers",
          .text = behind ? "it lies behind the light's plane"
                         : "no segment from a receiver to the light meets its box",
          .is_certificate = true,
          .numbers = {{"faces", static_cast<double>(caster.faces)}}};
}

/// The methods that may be run, in the order in which they are preferred at equal time.
std::vector<Candidate> candidates(const LightFacts& facts, const PlanRequest& request) {
  std::vector<Candidate> out;
  const auto samples = static_cast<std::uint64_t>(rays_for(facts, request.max_error));
  const int n = static_cast<int>(samples);
  if (!facts.is_rectangle)
    out.push_back(
        {"silhouette", {}, cost_of_silhouette(facts).over(request.frames), error_of_silhouette(facts)});
  // Certificates are of V: O is not asked of it.
  if (!facts.is_rectangle && !request.with_unoccluded)
    out.push_back({"rays",
                   {{"samples", samples}},
                   cost_of_rays(facts, n).over(request.frames),
                   error_of_rays(facts, n)});
  out.push_back({"reference",
                 {{"samples", samples}},
                 cost_of_reference(facts, n).over(request.frames),
                 error_of_rays(facts, n)});
  return out;
}

/// The cheapest that meets the error; where none does the most accurate.
const Candidate& best_of(const std::vector<Candidate>& all, double max_error) {
  const auto meets = [&](const Candidate& c) { return c.error <= max_error; };
  const bool any = std::ranges::any_of(all, meets);
  return *std::ranges::min_element(all, [&](const Candidate& a, const Candidate& b) {
    if (!any) return a.error < b.error;
    if (meets(a) != meets(b)) return meets(a);
    return a.milliseconds < b.milliseconds;
  });
}

Decision why_chosen(const Candidate& chosen, const std::vector<Candidate>& all, const LightFacts& facts,
                    const PlanRequest& request) {
  const bool meets = chosen.error <= request.max_error;
  Decision out{.about = "method", .choice = chosen.method, .reason = meets ? "cheapest" : "most-accurate"};
  out.text = meets ? "the cheapest by the model that keeps the error within " + shown(request.max_error)
                   : "no method keeps the error within " + shown(request.max_error) +
                         " by the model; this one comes nearest";
  for (const Candidate& each : all) {
    out.numbers.push_back({each.method + "_ms", each.milliseconds});
    out.numbers.push_back({each.method + "_error", each.error});
    if (const auto samples = each.options.find("samples"); samples != each.options.end())
      out.numbers.push_back(
          {each.method + "_samples", static_cast<double>(std::get<std::uint64_t>(samples->second))});
  }
  out.numbers.insert(out.numbers.end(), {{"penumbra", facts.sampled.penumbra},
                                         {"edges", facts.sampled.edges},
                                         {"merged_edges", facts.sampled.merged_edges},
                                         {"boxes", facts.sampled.boxes}});
  return out;
}

LightPlan& finish(LightPlan& plan, LightPlan::Action action, Decision why) {
  plan.action = action;
  plan.decisions.push_back(std::move(why));
  return plan;
}

void run(LightPlan& plan, const Candidate& chosen) {
  plan.method = chosen.method;
  plan.options = chosen.options;
  plan.milliseconds = chosen.milliseconds;
  plan.error = chosen.error;
}

}  // namespace

LightPlan make_plan(const LightFacts& facts, const PlanRequest& request) {
  if (!(request.max_error > 0.0)) throw UsageError("a plan's max-error must be above 0");
  LightPlan plan;
  plan.facts = facts;
  const auto receivers = static_cast<double>(facts.receivers);
  if (facts.dark == facts.receivers)
    return finish(plan, LightPlan::Action::kDark,
                  {.about = "light",
                   .choice = "nothing",
                   .reason = "reaches-no-receiver",
                   .text = "every receiver lies behind its plane or faces away from it",
                   .is_certificate = true,
                   .numbers = {{"receivers", receivers}}});
  bool any = false;
  for (const CasterFacts& caster : facts.casters) {
    plan.left_out.push_back(caster.reach != CasterReach::kMayReach);
    any = any || !plan.left_out.back();
    if (plan.left_out.back()) plan.decisions.push_back(why_left_out(caster));
  }
  if (!any)
    return finish(plan, LightPlan::Action::kUnshadowed,
                  {.about = "light",
                   .choice = "no shadows",
                   .reason = "no-caster-reaches",
                   .text = "no caster lies between it and a receiver",
                   .is_certificate = true,
                   .numbers = {{"receivers", receivers}}});
  if (facts.is_point) {
    run(plan, {"hard", {}, 0.0, 0.0});
    return finish(plan, LightPlan::Action::kMethod,
                  {.about = "method",
                   .choice = "hard",
                   .reason = "point-light",
                   .text = "a point has no penumbra; one ray a receiver is exact",
                   .is_certificate = true});
  }
  const std::vector<Candidate> all = candidates(facts, request);
  const Candidate& chosen = best_of(all, request.max_error);
  run(plan, chosen);
  return finish(plan, LightPlan::Action::kMethod, why_chosen(chosen, all, facts, request));
}

}  // namespace penumbra
