// bake: the scene as it is baked, and what tells one bake from another.
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "apps/cli/bake/bake_arguments.h"
#include "penumbra/render/bake/bake_receivers.h"

namespace penumbra::apps {

/// The scene with the lights that were asked for, in their order. Throws UsageError for names that it has
/// not.
Scene chosen_scene(const BakeArguments& arguments, Scene scene);

/// Their numbers, each once. Throws UsageError that lists the objects.
std::vector<std::size_t> object_numbers(const Scene& scene, const std::vector<std::string>& names);

/// "visibility", or one name a light; or R, G and B.
std::vector<std::string> channel_names(const Scene& scene, BakeQuantity quantity);

/// All that values depend on: numbers and words, and a digest of meshes and texture coordinates. `atlas` may
/// be null.
nlohmann::json settings_of(const BakeArguments& arguments, const Scene& scene, const TextureAtlas* atlas);

}  // namespace penumbra::apps
