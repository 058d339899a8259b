// What there is to know about a mesh before its shadow is computed: `penumbra inspect`.
#pragma once

#include <string>

#include "penumbra/mesh/triangle_mesh.h"

namespace penumbra {

/// Counts are of the built mesh (cut edges count as boundary), those in `build` of the input.
struct MeshFindings {
  std::size_t vertices = 0, edges = 0, faces = 0;
  std::size_t components = 0, closed_components = 0;
  std::size_t boundary_edges = 0, boundary_vertices = 0;
  BuildReport build;
  bool closed = false;
  Bounds bounds;
  double signed_volume = 0.0;  ///< sum over closed components, scene units³
  double surface_area = 0.0;   ///< scene units²
};
/// Cost O(V + E + F).
MeshFindings inspect(const TriangleMesh& mesh);
std::string to_text(const MeshFindings& findings);  ///< some lines for a person
std::string to_json(
    const MeshFindings& findings);  ///< one JSON object, keys as the members are named; bounds null if empty

}  // namespace penumbra
