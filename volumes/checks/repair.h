// Mending a mesh before its shadow is computed, component by component, and saying what was done. Part of
// penumbra::checks.
//
// The policy:
//  - closed, oriented, outward and free of self-intersections: kept as it is;
//  - a closed manifold once faces that repeat others are dropped, seams stitched, and faces turned alike (by
//  CGAL's
//    orient_polygon_soup) and outward: mended so;
//  - open, not manifold, not orientable or self-intersecting: left as it is. Its boundary edges belong to
//  every
//    silhouette band, and its penumbra volume has a cell for every face, so its shadow is right all the same.
// Nothing disappears: every input triangle is in the result or named in the report.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "penumbra/mesh/triangle_mesh.h"

namespace penumbra {

enum class RepairVerdict { kAsIs, kMended, kLeft };
const char* name_of(RepairVerdict verdict);

/// Ids are of input triangles.
struct ComponentRepair {
  RepairVerdict verdict = RepairVerdict::kAsIs;
  std::vector<std::uint32_t> faces;    ///< all of the component's, dropped ones too
  std::vector<std::uint32_t> dropped;  ///< mended: same three positions as an earlier face
  std::vector<std::uint32_t> flipped;  ///< mended: turned round
  std::size_t stitched_edges =
      0;  ///< mended: edges cut for their faces' orientation or repetition, now joined
  // Why it was left; counts of edges are after dropping repeated faces.
  std::size_t boundary_edges = 0;      ///< with one face
  std::size_t non_manifold_edges = 0;  ///< with more than two
  bool not_orientable = false;         ///< or with a vertex between separate fans that cannot be told apart
  std::size_t self_intersections = 0;  ///< pairs of faces
  bool all_counted = true;             ///< false: there are more pairs than were asked for
};

struct RepairResult {
  std::vector<Vec3> positions;                  ///< of the input, exact duplicates welded
  std::vector<IndexedTriangle> triangles;       ///< in the input's order
  std::vector<std::uint32_t> source_triangles;  ///< per triangle its index in the input
  std::vector<std::uint32_t>
      degenerate;  ///< input triangles with fewer than three distinct positions, dropped
  std::size_t welded_vertices = 0;
  std::vector<ComponentRepair> components;  ///< in the order of their lowest faces
};

struct RepairOptions {
  std::size_t most_intersections = 1000;  ///< counted in a component
};

/// Components are those of the built mesh where they are closed; the faces of open ones are gathered over
/// shared edges, whichever way they run. Throws MeshError as TriangleMesh::build does. Expected cost O(n log
/// n).
RepairResult repair(std::span<const Vec3> positions, std::span<const IndexedTriangle> triangles,
                    const RepairOptions& options = {});

std::string to_text(const RepairResult& result);  ///< some lines for a person; like components share a line
std::string to_json(const RepairResult& result);  ///< one JSON object, keys as the members are named

}  // namespace penumbra
