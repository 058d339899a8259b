// Bake: the meshes of a scene with the texture coordinates of its atlas, for programs that use the map.
#pragma once

#include <filesystem>
#include <span>

#include "penumbra/render/bake/texture_atlas.h"

namespace penumbra {

/// Writes the objects that the atlas has, in world space: .glb with the coordinates as TEXCOORD_1 (and as
/// TEXCOORD_0, which glTF asks for beside it) and albedos as base colors, in float around the middle of each
/// object; or .obj, in double, without materials. Faces of objects in `backs` are turned, so that their front
/// gets the light. The file is written whole or not at all. Throws UsageError for another extension,
/// SystemError where writing fails. Cost O(faces · log faces).
void write_atlas_mesh(const std::filesystem::path& path, const std::vector<SceneObject>& objects,
                      const TextureAtlas& atlas, std::span<const std::size_t> backs = {});

}  // namespace penumbra
