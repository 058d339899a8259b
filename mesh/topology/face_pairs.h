// Joins faces in pairs at edges where more than two meet.
//
// In: faces joined at ordinary edges, and the groups of edges with more than one face that are not. Out: more
// faces joined, so that closed surfaces that touch along edges stay closed, however these edges follow each
// other.
//
// At each edge the faces that may be parts of closed surfaces (closed_patches.h) are taken together, then the
// others. Where as many of them run along the edge one way as the other, they are paired by their angle about
// it: a face with the next one that bounds the same piece of solid, as brackets are paired. So solids that
// touch along an edge come apart there. Faces at one angle count as the end of one solid before the beginning
// of the next.
//
// Two edges must not have the same two ends. Where two pairs of one edge belong to the same fans at both
// ends, they change partners, which parts these fans; where faces that were not paired belong to the fans of
// a pair, the edge's pairs are cut.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/topology/half_edges.h"

namespace penumbra::detail {

/// Adds pairs to `opposite`. Expected cost O(F α(F) + K log K), K half-edges of crowded groups.
void pair_faces(std::span<const Vec3> positions, std::span<const IndexedTriangle> triangles,
                const EdgeGroups& groups, std::span<const std::uint32_t> crowded,
                std::vector<std::uint32_t>& opposite);

}  // namespace penumbra::detail
