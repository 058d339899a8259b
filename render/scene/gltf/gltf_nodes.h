// Nodes of a glTF scene with their places in the world.
#pragma once

#include <vector>

#include "render/scene/gltf/gltf_file.h"
#include "render/scene/gltf/gltf_notes.h"
#include "render/scene/transform.h"

namespace penumbra::detail {

struct PlacedNode {
  /// In the model.
  std::size_t node = 0;
  Transform world;
  /// Of EXT_mesh_gpu_instancing: where the node's mesh stands, in the world. Else `world` alone.
  std::vector<Transform> instances;
};

/// Where a node's -z points to; the world's -z where it is flattened to nothing.
Vec3 forward(const Transform& world);

/// Those of the default scene, or the first, in its order; of a file without scenes all nodes that are no
/// children. Throws SceneError where a node is its own ancestor, has two parents, or a matrix that is not
/// finite.
std::vector<PlacedNode> place_nodes(const GltfFile& file, GltfNotes& notes);

}  // namespace penumbra::detail
