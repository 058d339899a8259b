// Plans as JSON: what `penumbra plan --json` prints and `penumbra render --plan` reads.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "penumbra/render/plan/plan.h"
#include "penumbra/render/scene/scene.h"

namespace penumbra::apps {

nlohmann::json to_json(const LightFacts& facts);

/// {"lights": [...]}, one entry a light, in their order: what is done, what it rests on, and why.
nlohmann::json to_json(std::span<const Light> lights, std::span<const LightPlan> plans);

/// Of the scene's lights, in their order. Read are light, action, method, options and left_out; the rest is
/// for people. Throws UsageError that says what is wrong: names of lights, an unknown action, method or
/// option, objects that are not there.
std::vector<LightPlan> plans_from_json(const nlohmann::json& json, const Scene& scene);
/// The same of a file. Throws SystemError where it cannot be read, UsageError where it is no JSON.
std::vector<LightPlan> read_plans(const std::filesystem::path& file, const Scene& scene);

/// Registers the method that does what a file's plans say for the lights of a scene, and returns its name.
/// Once.
std::string method_of_plans(const std::filesystem::path& file, const Scene& scene);

}  // namespace penumbra::apps
