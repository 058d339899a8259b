// A mesh of glTF as a scene's meshes are: its primitives joined, with base colors, normals and one set of
// texture coordinates.
#pragma once

#include <optional>

#include "render/scene/gltf/gltf_file.h"
#include "render/scene/gltf/gltf_notes.h"
#include "render/scene/scene_mesh.h"

namespace penumbra::detail {

/// Of triangles, strips and fans; points and lines are ignored. `uv_set`: as SceneOptions::uv_set. Nothing
/// where no triangle is left. Throws SceneError for data that leave their buffers.
std::optional<MeshCache::Entry> read_gltf_mesh(const GltfFile& file, std::size_t mesh,
                                               std::optional<int> uv_set, GltfNotes& notes);

}  // namespace penumbra::detail
