// Solids: without the bodies of the casters.
#pragma once

#include <vector>

#include "volumes/solids/grid_surface.h"
#include "volumes/solids/shafts/caster_tree.h"
#include "volumes/solids/solid_mesher.h"

namespace penumbra::detail {

/// What closed components of casters enclose: points about which they wind a number of times that is not 0.
class CasterBodies {
 public:
  explicit CasterBodies(std::span<const TriangleMesh> casters);

  /// By exact signs. Cost O(log F + faces along a ray).
  bool hold(const Vec3& p) const;

 private:
  CasterTree tree_;
  std::vector<char> is_closed_;  ///< components
};

/// Takes grid points in bodies out of the solid. Edges that lead from the solid into a body are crossed where
/// the body begins: of umbras at the last point found outside of it, else at the first point found inside.
void leave_out_bodies(SolidGrid& grid, CrossedEdges& edges, const SolidMeshRequest& request);

}  // namespace penumbra::detail
