// A heightfield as triangle meshes, tile by tile.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <vector>

#include "penumbra/mesh/triangle_mesh.h"
#include "render/scene/heightfield/height_grid.h"
#include "render/scene/transform.h"

namespace penumbra::detail {

struct HeightTile {
  /// Among the tiles.
  std::size_t row = 0, column = 0;
  TriangleMesh mesh{};
  /// As SceneObject has them; empty unless asked for.
  std::vector<std::array<glm::vec3, 3>> corner_normals{};
};

struct TileOptions {
  /// Squares along a tile's side.
  std::size_t side = 256;
  /// Normals at posts: means, by area, over the triangles around.
  bool smooth = false;
};

/// In the mesh's coordinates x is east, y up and z south, so that a scene without a transform has north at
/// -z. Each square between four posts is two triangles that share the diagonal from its south-western to its
/// north-eastern post (where the first row is the northern one). A triangle at a gap is left out. Tiles that
/// meet have the same posts on their border, bit for bit; tiles without triangles are left out. Throws
/// MeshError where a post lies beyond kMostNumber. O(posts), on all cores: 32 million triangles take half a
/// minute on two cores.
std::vector<HeightTile> make_tiles(const HeightGrid& grid, const Transform& transform,
                                   const TileOptions& options);

}  // namespace penumbra::detail
