// Which faces may be parts of closed surfaces, where more than two faces meet at edges.
//
// A patch is a set of faces that ordinary edges connect. It is put aside
//   1. where it has an edge with no other face, or with one other that runs along it in the same direction;
//   2. where all faces at an edge that are not put aside run along it in one direction;
//   3. where, at each edge, it has no more faces than those not put aside have to spare in its direction (a
//      fin, a wall across a box): the patch of the least area first.
// At an edge where as many of the other faces run one way as the other, they can be joined in pairs.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/topology/half_edges.h"

namespace penumbra::detail {

/// For each face whether it is put aside. `opposite` joins faces at ordinary edges; `crowded` are the groups
/// of edges with more than one face that are not. Cost O(F α(F) + K log K), K half-edges of crowded groups;
/// rule 3 looks at a patch again when one beside it is put aside.
std::vector<bool> put_open_patches_aside(std::span<const Vec3> positions,
                                         std::span<const IndexedTriangle> triangles, const EdgeGroups& groups,
                                         std::span<const std::uint32_t> crowded,
                                         const std::vector<std::uint32_t>& opposite);

}  // namespace penumbra::detail
