// What there is to know about a mesh before its shadow is computed.
//
// In: a built mesh. Out: counts and measures as data, and a text of them for people.
#pragma once

#include <string>
#include <vector>

#include "penumbra/mesh/io/polygon_soup.h"
#include "penumbra/mesh/triangle_mesh.h"

namespace penumbra {

struct MeshFindings {
  /// Counts of the built mesh. The two sides of a cut edge count as two boundary edges.
  std::size_t vertices = 0, edges = 0, faces = 0;
  std::size_t components = 0, closed_components = 0;
  std::size_t boundary_edges = 0, boundary_vertices = 0;
  /// What TriangleMesh::build did with the input.
  BuildReport build;
  /// What triangulate did with the polygons of the file, where it is known.
  PolygonReport polygons;
  /// Some corners have normals.
  bool has_normals = false;
  /// Materials that the file names, and how many have a color.
  std::size_t materials = 0, colored_materials = 0;
  /// What the file has and is not used.
  std::vector<std::string> ignored;
  /// Every component is closed, and there is at least one.
  bool closed = false;
  Bounds bounds;
  /// The sum over closed components, scene units³.
  double signed_volume = 0.0;
  /// Scene units².
  double surface_area = 0.0;
};

/// Cost O(V + E + F).
MeshFindings inspect(const TriangleMesh& mesh);
/// The same with what became of the file.
MeshFindings inspect(const LoadedMesh& loaded);

/// Some lines for a person. Ends with a newline.
std::string to_text(const MeshFindings& findings);

}  // namespace penumbra
