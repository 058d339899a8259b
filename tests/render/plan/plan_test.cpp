// The planner's decisions, from facts made by hand.
#include "penumbra/render/plan/plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "penumbra/mesh/error.h"
#include "render/plan/cost_model.h"

namespace penumbra {
namespace {

LightFacts ordinary() {
  return {
      .receivers = 300'000,
      .dark = 20'000,
      .casters = {{.object = 1, .name = "bunny.ply", .faces = 3'000, .edges = 4'500},
                  {.object = 2, .name = "box.off", .faces = 12, .edges = 18}},
      .sampled = {
          .receivers = 512,
          .lit = {.share = 0.75},
          .penumbra = {.share = 0.15, .edges = 2.0, .merged_edges = 2.0, .edge_length = 3.0, .boxes = 4.0},
          .hidden = {.share = 0.1, .boxes = 4.0},
          .variance = 0.12,
          .boundary = 0.2}};
}

LightFacts crowded() {
  LightFacts facts = ordinary();
  facts.casters[0].faces = 60'000;
  facts.casters[0].edges = 180'000;
  facts.sampled.lit.share = 0.2;
  facts.sampled.boundary = 1.0;
  facts.sampled.penumbra = {
      .share = 0.7, .edges = 6'000.0, .merged_edges = 6'000.0, .edge_length = 6'000.0, .boxes = 40.0};
  return facts;
}

const Decision& decision_about(const LightPlan& plan, const std::string& about) {
  const auto found = std::ranges::find(plan.decisions, about, &Decision::about);
  if (found == plan.decisions.end()) throw std::out_of_range(about);
  return *found;
}

TEST(Plan, ALightThatReachesNoReceiverDoesNothing) {
  LightFacts facts = ordinary();
  facts.dark = facts.receivers;
  const LightPlan plan = make_plan(facts, {});
  EXPECT_EQ(plan.action, LightPlan::Action::kDark);
  EXPECT_EQ(decision_about(plan, "light").reason, "reaches-no-receiver");
  EXPECT_TRUE(decision_about(plan, "light").is_certificate);
}

TEST(Plan, CastersThatReachNoReceiverAreLeftOut) {
  LightFacts facts = ordinary();
  facts.casters[0].reach = CasterReach::kMissesReceivers;
  const LightPlan plan = make_plan(facts, {});
  EXPECT_EQ(plan.action, LightPlan::Action::kMethod);
  EXPECT_EQ(plan.left_out, std::vector<std::size_t>{1});
  EXPECT_EQ(decision_about(plan, "caster 1 (bunny.ply)").reason, "misses-receivers");
  EXPECT_EQ(decision_about(plan, "caster 1 (bunny.ply)").choice, "left out");
  // For twelve faces of three thousand no method is made anew.
  LightFacts few = ordinary();
  few.casters[1].reach = CasterReach::kMissesReceivers;
  EXPECT_TRUE(make_plan(few, {}).left_out.empty());
  EXPECT_EQ(decision_about(make_plan(few, {}), "caster 2 (box.off)").choice, "no shadow");
  facts.casters[1].reach = CasterReach::kBehindLight;
  const LightPlan none = make_plan(facts, {});
  EXPECT_EQ(none.action, LightPlan::Action::kUnshadowed);
  EXPECT_EQ(decision_about(none, "caster 2 (box.off)").reason, "behind-light");
  EXPECT_EQ(decision_about(none, "light").reason, "no-caster-reaches");
}

TEST(Plan, APointHasAHardShadow) {
  LightFacts facts = ordinary();
  facts.is_point = true;
  EXPECT_EQ(make_plan(facts, {}).method, "hard");
}

TEST(Plan, ANarrowPenumbraIsHardWhereThatIsAskedFor) {
  LightFacts facts = ordinary();
  facts.widest_penumbra = 0.1;
  EXPECT_EQ(make_plan(facts, {}).method, "silhouette");
  const LightPlan plan = make_plan(facts, {.hard_below = 0.2});
  EXPECT_EQ(plan.method, "hard");
  EXPECT_EQ(decision_about(plan, "method").reason, "narrow-penumbra");
  EXPECT_EQ(make_plan(facts, {.hard_below = 0.1}).method, "silhouette");
}

TEST(Plan, FewEdgesAreIntegratedAndManyAreLeftToRays) {
  EXPECT_EQ(make_plan(ordinary(), {}).method, "silhouette");
  const LightPlan plan = make_plan(crowded(), {});
  EXPECT_TRUE(plan.method == "reference" || plan.method == "rays") << plan.method;
  EXPECT_LE(plan.error, 0.01);
  EXPECT_FALSE(decision_about(plan, "method").is_certificate);
}

TEST(Plan, MoreRaysAreTakenForLessError) {
  std::uint64_t before = 0;
  for (const double error : {0.1, 0.03, 0.01}) {
    LightFacts facts = crowded();
    facts.is_rectangle = true;  // rays alone take it
    const LightPlan plan = make_plan(facts, {.max_error = error});
    ASSERT_EQ(plan.method, "reference");
    EXPECT_LE(plan.error, error);
    const auto samples = std::get<std::uint64_t>(plan.options.at("samples"));
    EXPECT_GT(samples, before) << error;
    before = samples;
  }
}

TEST(Plan, SaysWhereNoMethodIsSoAccurate) {
  const LightPlan plan = make_plan(crowded(), {.max_error = 1e-9});
  EXPECT_EQ(decision_about(plan, "method").reason, "most-accurate");
  EXPECT_THROW(make_plan(ordinary(), {.max_error = 0.0}), UsageError);
}

TEST(Plan, KeepsATimeWhereItCannotKeepBoth) {
  const LightPlan free = make_plan(crowded(), {});
  const LightPlan hurried = make_plan(crowded(), {.max_ms = 0.1 * free.milliseconds});
  EXPECT_EQ(decision_about(hurried, "method").reason, "within-time");
  EXPECT_LE(hurried.milliseconds, 0.1 * free.milliseconds);
  EXPECT_GT(hurried.error, 0.01);
  EXPECT_EQ(make_plan(crowded(), {.max_ms = 2.0 * free.milliseconds}).milliseconds, free.milliseconds);
  EXPECT_EQ(decision_about(make_plan(crowded(), {.max_ms = 1e-6}), "method").reason, "fastest");
}

// A mesh of millions is not worth its hierarchy of edges for one frame of few pixels.
TEST(Plan, SharesSetUpAmongFrames) {
  LightFacts facts = ordinary();
  facts.casters[0].faces = 5'000'000;
  facts.casters[0].edges = 7'500'000;
  facts.receivers = 30'000;
  const LightPlan one = make_plan(facts, {.max_error = 0.05}),
                  many = make_plan(facts, {.max_error = 0.05, .frames = 10'000});
  EXPECT_EQ(one.method, "reference");
  const auto silhouette_ms = [](const LightPlan& plan) {
    const std::vector<DecisionNumber>& numbers = decision_about(plan, "method").numbers;
    return std::ranges::find(numbers, "silhouette_ms", &DecisionNumber::name)->value;
  };
  EXPECT_LT(silhouette_ms(many), 0.5 * silhouette_ms(one));
}

TEST(Plan, ChoosesTheCheapestOfWhatKeepsTheError) {
  for (const LightFacts& facts : {ordinary(), crowded()})
    for (const double error : {0.1, 0.01, 0.003}) {
      const LightPlan plan = make_plan(facts, {.max_error = error});
      const std::vector<DecisionNumber> numbers = decision_about(plan, "method").numbers;
      const auto value = [&](const std::string& name) {
        return std::ranges::find(numbers, name, &DecisionNumber::name)->value;
      };
      for (const char* method : {"silhouette", "rays", "reference"})
        if (value(std::string(method) + "_error") <= error) {
          EXPECT_LE(plan.milliseconds, value(std::string(method) + "_ms")) << method << ", " << error;
        }
    }
}

TEST(CostModel, ErrorsOfRaysFallAndAreNeverWorseThanChance) {
  for (const LightFacts& facts : {ordinary(), crowded()}) {
    double before = 1.0;
    for (const int samples : {4, 16, 64, 256, 1024}) {
      const double error = detail::error_of_rays(facts, samples);
      EXPECT_LT(error, before);
      EXPECT_LE(error, std::sqrt(facts.sampled.variance / samples));
      before = error;
    }
  }
}

}  // namespace
}  // namespace penumbra
