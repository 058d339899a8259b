// Planner, step choose: the methods that may be run for a light, with their options, and what the model says
// of each.
#pragma once

#include <string>
#include <vector>

#include "penumbra/render/plan/plan.h"

namespace penumbra::detail {

struct Candidate {
  std::string method;
  OptionValues options;
  /// By the model, on a machine of the request's speed; RMSE of V over the penumbra.
  double milliseconds, error;
};

/// In the order in which they are preferred at equal time: with as many rays as the error asks for, and with
/// fewer where time is limited. Empty where the request's effects leave none.
std::vector<Candidate> candidates(const LightFacts& facts, const PlanRequest& request);

}  // namespace penumbra::detail
