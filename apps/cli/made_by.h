// What made an image: text that goes into its EXR, so that compare can say what it compares.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "penumbra/render/renderer.h"

namespace penumbra::apps {

using Metadata = std::map<std::string, std::string>;

/// Lights and camera of a scene, as JSON.
Metadata metadata_of(const Scene& scene);
/// The same, with version, method, all of its options (seed and samples too) and the scene's path.
Metadata metadata_of(const Scene& scene, const std::string& path, const RenderResult& result);

/// "reference (samples 64, seed 1) of cube.json by penumbra 0.2.0": of options those that are not the usual
/// ones, and samples and seed. Says so where the file does not know.
std::string made_by(const Metadata& metadata);
/// The same for programs.
nlohmann::json made_by_json(const Metadata& metadata);

/// "lights", "camera": what both know and is not the same.
std::vector<std::string> differences(const Metadata& a, const Metadata& b);

}  // namespace penumbra::apps
