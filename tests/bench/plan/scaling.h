// What casters and lights cost that the picture does not call for: `penumbra_plan_bench scaling`.
#pragma once

#include <nlohmann/json.hpp>

namespace penumbra::bench {

/// Whole frames of the method auto at 320x240, milliseconds of one thread, everything found anew but one-time
/// set-up: 10 casters of 2,048 faces that matter, the same beside 990 whose shadows nobody sees; 3 lights
/// that reach the picture, the same beside 97 that do not. And of the 3 lights' frame its share of planning.
nlohmann::json measure_scaling();

}  // namespace penumbra::bench
