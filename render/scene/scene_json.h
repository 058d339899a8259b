// From a JSON document to a scene.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "penumbra/render/scene/scene.h"

namespace penumbra::detail {

/// As parse_scene. Throws SceneError, MeshError.
LoadedScene read_scene(const nlohmann::json& document, const std::filesystem::path& folder,
                       const std::string& name, const SceneOptions& options);

}  // namespace penumbra::detail
