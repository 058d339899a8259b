// A mesh of glTF as a scene's meshes are: its primitives joined, with base colors and normals.
#pragma once

#include <optional>

#include "render/scene/gltf/gltf_file.h"
#include "render/scene/gltf/gltf_notes.h"
#include "render/scene/scene_mesh.h"

namespace penumbra::detail {

/// Of triangles, strips and fans; points and lines are ignored. Nothing where no triangle is left. Throws SceneError for data that leave
/// their buffers.
std::optional<MeshCache::Entry> read_gltf_mesh(const GltfFile& file, std::size_t mesh, GltfNotes& notes);

}  // namespace penumbra::detail
