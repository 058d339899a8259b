// What --stats writes: a picture's method, options, times and counts as JSON.
#pragma once

#include <nlohmann/json.hpp>

#include "penumbra/render/renderer.h"

namespace penumbra::apps {

/// `threads`: those that were used. Times are milliseconds, bytes are bytes. Counts of several lights are
/// under "lights", in the scene's order.
nlohmann::json stats_of(const RenderResult& result, int threads);

nlohmann::json to_json(const OptionValues& values);
nlohmann::json to_json(const StageTimes& stages);
nlohmann::json to_json(const Counts& counts);
/// A list; numbers under "numbers".
nlohmann::json to_json(const std::vector<Decision>& decisions);

}  // namespace penumbra::apps
