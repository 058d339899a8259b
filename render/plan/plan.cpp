#include "penumbra/render/plan/plan.h"

#include <algorithm>
#include <cstdio>

#include "penumbra/mesh/error.h"
#include "render/plan/candidates.h"
#include "render/plan/cost_model.h"

namespace penumbra {
namespace {

using namespace detail;

std::string shown(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

std::string name_of(const CasterFacts& caster) {
  return "caster " + std::to_string(caster.object) + (caster.name.empty() ? "" : " (" + caster.name + ")");
}

/// Of a caster that reaches no receiver.
Decision about_caster(const CasterFacts& caster, bool left_out) {
  const bool behind = caster.reach == CasterReach::kBehindLight;
  return {.about = name_of(caster),
          .choice = left_out ? "left out" : "no shadow",
          .reason = behind ? "behind-light" : "misses-receivers",
          .text = behind ? "it lies behind the light's plane"
                         : "no segment from a receiver to the light meets its box",
          .is_certificate = true,
          .numbers = {{"faces", static_cast<double>(caster.faces)}}};
}

struct Choice {
  const Candidate* candidate;
  const char* reason;
  std::string text;
};

/// The cheapest that keeps the error; where none does in time, the most accurate of those that keep the time.
Choice choose(const std::vector<Candidate>& all, const PlanRequest& request) {
  const auto keeps_error = [&](const Candidate& c) { return c.error <= request.max_error; };
  const auto keeps_time = [&](const Candidate& c) {
    return !(request.max_ms > 0.0) || c.milliseconds <= request.max_ms;
  };
  const auto cheapest = [&](const auto& suits) {
    const Candidate* best = nullptr;
    for (const Candidate& each : all)
      if (suits(each) && (!best || each.milliseconds < best->milliseconds)) best = &each;
    return best;
  };
  const std::string error = shown(request.max_error), time = shown(request.max_ms) + " ms";
  const Candidate* accurate = cheapest(keeps_error);
  if (accurate && keeps_time(*accurate))
    return {accurate, "cheapest", "by the model it is the cheapest that keeps the error within " + error};
  const Candidate* best = nullptr;
  for (const Candidate& each : all)
    if (keeps_time(each) && (!best || each.error < best->error)) best = &each;
  if (!best)
    return {cheapest([](const Candidate&) { return true; }), "fastest",
            "by the model no method keeps within " + time + "; it comes nearest"};
  if (accurate)
    return {best, "within-time",
            "by the model it is the most accurate within " + time + "; an error within " + error + " takes " +
                shown(accurate->milliseconds) + " ms"};
  return {best, "most-accurate",
          "by the model no method keeps the error within " + error + "; it comes nearest"};
}

Decision why_chosen(const Choice& choice, const std::vector<Candidate>& all, const LightFacts& facts,
                    double speed) {
  Decision out{.about = "method",
               .choice = choice.candidate->method,
               .reason = choice.reason,
               .text = choice.text,
               .numbers = {{"ms", choice.candidate->milliseconds}, {"error", choice.candidate->error}}};
  // What it was compared with: each method once, with the most rays.
  for (const Candidate& each : all) {
    if (std::ranges::find(out.numbers, each.method + "_ms", &DecisionNumber::name) != out.numbers.end())
      continue;
    out.numbers.push_back({each.method + "_ms", each.milliseconds});
    out.numbers.push_back({each.method + "_error", each.error});
    if (const auto samples = each.options.find("samples"); samples != each.options.end())
      out.numbers.push_back(
          {each.method + "_samples", static_cast<double>(std::get<std::uint64_t>(samples->second))});
  }
  if (speed != 1.0) out.numbers.push_back({"assumed_speed", speed});
  const SampledFacts& sampled = facts.sampled;
  out.numbers.insert(out.numbers.end(), {{"penumbra_share", sampled.penumbra.share},
                                         {"edges_in_penumbra", sampled.penumbra.edges},
                                         {"edges_where_hidden", sampled.hidden.edges},
                                         {"boxes", sampled.penumbra.boxes}});
  return out;
}

void finish(LightPlan& plan, LightPlan::Action action, Decision why) {
  plan.action = action;
  plan.decisions.push_back(std::move(why));
}

void run(LightPlan& plan, const Candidate& chosen) {
  plan.method = chosen.method;
  plan.options = chosen.options;
  plan.milliseconds = chosen.milliseconds;
  plan.error = chosen.error;
}

void finish_hard(LightPlan& plan, Decision why) {
  why.about = "method";
  why.choice = plan.method = "hard";
  finish(plan, LightPlan::Action::kMethod, std::move(why));
}

/// Notes which casters reach no receiver, and leaves them out where that is worth it. Returns whether any
/// reaches one.
bool leave_out(LightPlan& plan, const LightFacts& facts, EffectChoice wish) {
  const bool worth =
      wish == EffectChoice::kOn || (wish == EffectChoice::kPlanned && is_worth_leaving_out(facts));
  bool any = false;
  for (const CasterFacts& caster : facts.casters) {
    const bool reaches = caster.reach == CasterReach::kMayReach;
    any = any || reaches;
    if (reaches) continue;
    if (worth) plan.left_out.push_back(caster.object);
    plan.decisions.push_back(about_caster(caster, worth));
  }
  return any;
}

/// Whether there is nothing for a method to do.
bool decide_without_method(LightPlan& plan, const LightFacts& facts, const Effects& effects) {
  const DecisionNumber receivers{"receivers", static_cast<double>(facts.receivers)};
  if (facts.dark == facts.receivers) {
    finish(plan, LightPlan::Action::kDark,
           {.about = "light",
            .choice = "nothing",
            .reason = "reaches-no-receiver",
            .text = "every receiver lies behind its plane or faces away from it",
            .is_certificate = true,
            .numbers = {receivers}});
    return true;
  }
  if (effects.shadows == EffectChoice::kOff) {
    finish(plan, LightPlan::Action::kUnshadowed,
           {.about = "light", .choice = "no shadows", .reason = "told", .text = "shadows are off"});
    return true;
  }
  if (leave_out(plan, facts, effects.culling) || effects.shadows == EffectChoice::kOn) return false;
  finish(plan, LightPlan::Action::kUnshadowed,
         {.about = "light",
          .choice = "no shadows",
          .reason = "no-caster-reaches",
          .text = "no caster lies between it and a receiver",
          .is_certificate = true,
          .numbers = {receivers}});
  return true;
}

/// Whether shadows are hard.
bool decide_hard(LightPlan& plan, const LightFacts& facts, const PlanRequest& request) {
  const EffectChoice penumbra = request.effects.penumbra;
  if (facts.is_point)
    finish_hard(plan, {.reason = "point-light",
                       .text = "a point has no penumbra; one ray a receiver is exact",
                       .is_certificate = true});
  else if (penumbra == EffectChoice::kOff)
    finish_hard(plan, {.reason = "told", .text = "penumbras are off"});
  else if (facts.widest_penumbra < request.hard_below && penumbra != EffectChoice::kOn)
    finish_hard(
        plan, {.reason = "narrow-penumbra",
               .text = "no penumbra is as wide as " + shown(request.hard_below) + " pixels on flat surfaces",
               .numbers = {{"widest_penumbra_pixels", facts.widest_penumbra}}});
  return !plan.method.empty();
}

}  // namespace

LightPlan make_plan(const LightFacts& facts, const PlanRequest& request) {
  if (!(request.max_error > 0.0)) throw UsageError("a plan's max-error must be above 0");
  if (!(request.speed > 0.0)) throw UsageError("a plan's speed must be above 0");
  LightPlan plan;
  plan.facts = facts;
  if (decide_without_method(plan, facts, request.effects) || decide_hard(plan, facts, request)) return plan;
  const std::vector<Candidate> all = candidates(facts, request);
  if (all.empty()) throw UsageError("no method is left for this light; leave more effects planned");
  const Choice choice = choose(all, request);
  run(plan, *choice.candidate);
  finish(plan, LightPlan::Action::kMethod, why_chosen(choice, all, facts, request.speed));
  return plan;
}

}  // namespace penumbra
