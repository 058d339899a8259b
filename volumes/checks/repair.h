// Mends a mesh before its shadow is computed, component by component, and says what was done.
//
// In: positions and triangles as they come. Out: positions and triangles, and a report. Each component is
//  - kept as it is, if it is closed, oriented, outward (inward round a cavity) and free of
//    self-intersections;
//  - mended, if it becomes so when faces that repeat others are dropped, seams are stitched, and faces are
//    turned alike (by CGAL's orient_polygon_soup) and outward;
//  - left as it is, if it is open, not manifold, not orientable or self-intersecting. Its shadow is right all
//    the same: its boundary edges belong to every silhouette band, and its penumbra volume has a cell for
//    every face.
// Nothing disappears: every input triangle is in the result or named in the report.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "penumbra/mesh/triangle_mesh.h"

namespace penumbra {

enum class RepairVerdict { kAsIs, kMended, kLeft };
/// "as_is", "mended" or "left".
const char* name_of(RepairVerdict verdict);

/// What was done with one component. Numbers of faces are those of input triangles.
struct ComponentRepair {
  RepairVerdict verdict = RepairVerdict::kAsIs;
  /// All of the component's, dropped ones too.
  std::vector<std::uint32_t> faces;

  /// Mended: faces with the same three positions as another one, whichever way they run, which were dropped.
  std::vector<std::uint32_t> dropped;
  /// Mended: faces that were turned round.
  std::vector<std::uint32_t> flipped;
  /// Mended: edges that were cut, for their faces' orientation or repetition, and now are joined.
  std::size_t stitched_edges = 0;

  /// Left: edges with one face, and edges with more than two, after repeated faces are dropped.
  std::size_t boundary_edges = 0;
  std::size_t non_manifold_edges = 0;
  /// Left: no orientation fits all faces, or a vertex between separate fans of faces cannot be split.
  bool not_orientable = false;
  /// Left: pairs of faces. `all_counted` is false where there are more of them than were asked for.
  std::size_t self_intersections = 0;
  bool all_counted = true;
};

struct RepairResult {
  /// Those of the input, with exact duplicates welded.
  std::vector<Vec3> positions;
  /// In the order of the input.
  std::vector<IndexedTriangle> triangles;
  /// For each triangle its index in the input.
  std::vector<std::uint32_t> source_triangles;
  /// Input triangles with fewer than three distinct positions. They are dropped.
  std::vector<std::uint32_t> degenerate;
  std::size_t welded_vertices = 0;
  /// In the order of their lowest faces.
  std::vector<ComponentRepair> components;
};

struct RepairOptions {
  /// How many self-intersections of a component are counted. The search stops there.
  std::size_t most_intersections = 1000;
};

/// Components are those of the built mesh where they are closed. One all of whose faces repeat faces of
/// others is dropped. The faces of open ones are collected over shared edges, whichever way they run along
/// them. Throws MeshError as TriangleMesh::build does. Expected cost O(n log n) for n triangles, in exact
/// arithmetic where needed.
RepairResult repair(std::span<const Vec3> positions, std::span<const IndexedTriangle> triangles,
                    const RepairOptions& options = {});

/// Some lines for a person. Components for which the same is said share a line. Ends with a newline.
std::string to_text(const RepairResult& result);

}  // namespace penumbra
