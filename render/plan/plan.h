// The planner: which casters and which method a light needs, by what was measured of it.
//
//   measure_light   scene, light, receivers → LightFacts          (light_facts.h)
//   make_plan       LightFacts, PlanRequest → LightPlan           (here)
//   the method auto does what the plan says                        (auto_method.h)
//
// What a plan leaves out is left out by a certificate: a proof that no receiver's visibility changes. What it chooses, it
// chooses by a model of times and errors (cost_model.h), whose constants were fitted to measurements. The plan depends
// on its arguments alone: the same picture has the same plan on every machine.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "penumbra/render/method_option.h"
#include "penumbra/render/support/decision.h"

namespace penumbra {

/// Whether a caster can change what some receiver sees of a light.
enum class CasterReach {
  /// It may. Nothing was proved.
  kMayReach,
  /// It lies behind the light's plane.
  kBehindLight,
  /// No segment from a receiver that the light reaches to a point of the light meets the caster's box.
  kMissesReceivers,
};

struct CasterFacts {
  /// Index in Scene::objects, and the object's name.
  std::size_t object = 0;
  std::string name{};
  std::size_t faces = 0, edges = 0;
  CasterReach reach = CasterReach::kMayReach;
};

/// Of receivers chosen evenly among those that the light reaches. Estimates, the same in every run.
struct SampledFacts {
  /// Receivers that were looked at, with 16 rays each.
  std::size_t receivers = 0;
  /// The share of those that see a part of the light.
  double penumbra = 0.0;
  /// The mean of O (1 - O) over these.
  double variance = 0.0;
  /// Silhouette edges that cross the light as one of these sees it, the mean; and the same where fine faces are merged.
  double edges = 0.0, merged_edges = 0.0;
  /// Boxes of faces that a ray from one of these to the light's center meets, the mean.
  double boxes = 0.0;
};

/// What is known of one light before anything is computed for it.
struct LightFacts {
  bool is_point = false, is_rectangle = false;
  /// Receivers that are present. Of these, those that lie behind the light's plane or face away from all of it, as far
  /// as groups of neighbors tell: they see none of it.
  std::size_t receivers = 0, dark = 0;
  /// The scene's objects that cast, in their order.
  std::vector<CasterFacts> casters{};
  SampledFacts sampled{};
};

struct PlanRequest {
  /// RMSE of V over the penumbra.
  double max_error = 0.01;
  /// O is wanted, too.
  bool with_unoccluded = false;
  /// The hierarchies that a method makes once are used for so many frames.
  int frames = 1;
};

struct LightPlan {
  enum class Action {
    /// No receiver sees any of the light.
    kDark,
    /// No caster hides any of it from any receiver.
    kUnshadowed,
    /// A method is run.
    kMethod,
  };
  Action action = Action::kMethod;
  /// For kMethod: its name and options.
  std::string method{};
  OptionValues options{};
  /// One flag a caster of the facts: it is left out.
  std::vector<char> left_out{};
  /// For kMethod, by the model: milliseconds on the machine of the fit, and RMSE of V over the penumbra.
  double milliseconds = 0.0, error = 0.0;
  std::vector<Decision> decisions{};
  /// What it rests on.
  LightFacts facts{};
};

/// Cost O(casters). Throws UsageError for a max_error that is not above 0.
LightPlan make_plan(const LightFacts& facts, const PlanRequest& request);

}  // namespace penumbra
