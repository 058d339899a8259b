// The planner: which casters and which method a light needs, by what was measured of it.
//
//   measure_light   scene, light, receivers → LightFacts          (light_facts.h)
//   make_plan       LightFacts, PlanRequest → LightPlan           (here)
//   the method auto does what the plan says                        (auto_method.h)
//
// What a plan leaves out is left out by a certificate: a proof that no receiver's visibility changes. What it
// chooses, it chooses by a model of times and errors (cost_model.h), whose constants were fitted to
// measurements. The plan depends on its arguments alone: the same picture has the same plan on every machine.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "penumbra/render/method_option.h"
#include "penumbra/render/plan/effects.h"
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

/// Receivers that are alike in what they see of the light: all of it, a part, or none.
struct SampledPart {
  /// Their share of the receivers.
  double share = 0.0;
  /// Means of what lies before the light as one of these sees it: silhouette edges; the same where fine faces
  /// are merged; the length of all these edges, light radii; boxes of faces that the ray to the light's
  /// center meets, up to the first face that it hits.
  double edges = 0.0, merged_edges = 0.0, edge_length = 0.0, boxes = 0.0;
  /// The silhouette edges before each that was looked at, ascending.
  std::vector<double> edges_each{};
};

/// Two independent estimates of V by so many rays each, at some receivers in penumbra: their difference tells
/// their error.
struct RayPilot {
  struct Receiver {
    /// How many of the receivers that were looked at it stands for.
    double weight = 1.0;
    /// Half the squared difference of the estimates: on average the squared error of one.
    double error2 = 0.0;
    /// Silhouette edges before it.
    double edges = 0.0;
    /// Those of one group lie beside each other. One group after another.
    std::uint32_t group = 0;
  };
  int samples = 1;
  std::vector<Receiver> each{};
};

/// Of receivers chosen evenly among those that the light reaches, told apart by 16 rays each. Estimates, the
/// same in every run.
struct SampledFacts {
  std::size_t receivers = 0;
  /// Of the casters that may reach: how many edges can be a silhouette for some receiver (the band).
  double band_edges = 0.0;
  SampledPart lit{}, penumbra{}, hidden{};
  /// Over the penumbra: the mean v of O (1 - O), so that the squared error of n rays by chance is v / n; and
  /// b, so that b / n^(3/2) is that of n stratified rays, many of which fall into strata that no boundary
  /// crosses.
  double variance = 0.0, boundary = 0.0;
  /// One with few rays, and where rays are likely to be chosen one with about as many as the error asks for.
  std::vector<RayPilot> pilots{};
  /// Of so many edges one was looked at.
  double edges_a_sample = 1.0;
};

/// What is known of one light before anything is computed for it.
struct LightFacts {
  bool is_point = false, is_rectangle = false;
  /// Receivers that are present. Of these, those in groups of neighbors that lie behind the light's plane or
  /// face away from all of it: they see none of it. As many as there are where no receiver at all sees any of
  /// it.
  std::size_t receivers = 0, dark = 0;
  /// The widest penumbra in distances between pixels, at most (penumbra_width.h); measured where
  /// PlanRequest::hard_below asks for it, else infinite.
  double widest_penumbra = std::numeric_limits<double>::infinity();
  /// The scene's objects that cast, in their order.
  std::vector<CasterFacts> casters{};
  SampledFacts sampled{};
};

struct PlanRequest {
  /// RMSE of V over the penumbra.
  double max_error = 0.01;
  /// Milliseconds by the model; where the error cannot be kept in it, the most accurate method that can keep
  /// the time is chosen. 0: no limit.
  double max_ms = 0.0;
  /// Pixels: a penumbra that is nowhere as wide is drawn as a hard shadow, whatever the error. 0: none is.
  double hard_below = 0.0;
  /// O is wanted, too.
  bool with_unoccluded = false;
  /// The hierarchies that a method makes once are used for so many frames.
  int frames = 1;
  /// How many times as fast this machine is as that of the model's fit. Only max_ms and the times that are
  /// said depend on it.
  double speed = 1.0;
  Effects effects{};
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
  /// Objects of the scene that cast no shadow here, ascending: left out of what the method is made for. Only
  /// where that halves the faces: what is made once is else shared with other lights.
  std::vector<std::size_t> left_out{};
  /// For kMethod, by the model: milliseconds on the machine of the fit, and RMSE of V over the penumbra.
  double milliseconds = 0.0, error = 0.0;
  std::vector<Decision> decisions{};
  /// What it rests on.
  LightFacts facts{};
};

/// Cost O(casters). Throws UsageError for a max_error or speed that is not above 0, and for effects that
/// leave no method.
LightPlan make_plan(const LightFacts& facts, const PlanRequest& request);

}  // namespace penumbra
