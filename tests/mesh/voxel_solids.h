// Solids of unit cubes on a grid, as meshes that share corners: many edges with four faces, following each
// other.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <random>
#include <set>
#include <vector>

#include "penumbra/mesh/types.h"

namespace penumbra::test {

using Voxel = std::array<int, 3>;

struct VoxelMesh {
  std::vector<Vec3> positions;
  std::vector<IndexedTriangle> triangles;
};

/// Each side between a voxel of the set and one outside it gives two triangles that face outward.
inline VoxelMesh mesh_of_voxels(const std::set<Voxel>& voxels) {
  VoxelMesh mesh;
  std::map<Voxel, std::uint32_t> vertices;
  const auto vertex = [&](const Voxel& at) {
    const auto [found, is_new] = vertices.try_emplace(at, static_cast<std::uint32_t>(mesh.positions.size()));
    if (is_new) mesh.positions.emplace_back(at[0], at[1], at[2]);
    return found->second;
  };
  for (const Voxel& voxel : voxels)
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (const int way : {0, 1}) {
        Voxel beside = voxel;
        beside[axis] += way == 1 ? 1 : -1;
        if (voxels.contains(beside)) continue;
        const std::size_t first = (axis + (way == 1 ? 1 : 2)) % 3, second = (axis + (way == 1 ? 2 : 1)) % 3;
        std::array<Voxel, 4> corners;
        corners.fill(voxel);
        for (Voxel& corner : corners) corner[axis] += way;
        ++corners[1][first], ++corners[2][first], ++corners[2][second], ++corners[3][second];
        std::array<std::uint32_t, 4> v;
        for (std::size_t i = 0; i < 4; ++i) v[i] = vertex(corners[i]);
        mesh.triangles.push_back({v[0], v[1], v[2]});
        mesh.triangles.push_back({v[0], v[2], v[3]});
      }
  return mesh;
}

/// Each voxel of a cube of so many is taken with the probability given.
inline std::set<Voxel> random_voxels(std::mt19937_64& random, int side, double density) {
  std::set<Voxel> voxels;
  std::bernoulli_distribution is_taken(density);
  for (int x = 0; x < side; ++x)
    for (int y = 0; y < side; ++y)
      for (int z = 0; z < side; ++z)
        if (is_taken(random)) voxels.insert({x, y, z});
  return voxels;
}

}  // namespace penumbra::test
