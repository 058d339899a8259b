// A scene of a glTF file: nodes with meshes become objects, KHR_lights_punctual lights, the first camera the
// camera.
//
// Objects of a scene hold their meshes in world space: instances in the same place share one, others have
// each their own. Nothing is taken of materials but base colors, and nothing of animations, skins and morph
// targets; warnings name what is left out.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include "penumbra/render/scene/scene.h"

namespace penumbra::detail {

/// Throws SceneError where the file cannot be used, MeshError where its coordinates cannot.
LoadedScene read_gltf(std::span<const std::byte> bytes, const std::filesystem::path& folder,
                      const std::string& name, const SceneOptions& options);

}  // namespace penumbra::detail
