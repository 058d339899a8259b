// Solids: a surface on grid edges is moved to the safe side, triangle by triangle.
#pragma once

#include "volumes/solids/grid_surface.h"
#include "volumes/solids/shafts/caster_tree.h"
#include "volumes/solids/solid_mesher.h"
#include "volumes/solids/triangle_points.h"

namespace penumbra::detail {

/// What triangles are judged by: shafts, and for the umbra points where shafts prove nothing. Refers to its arguments.
class TriangleJudge {
 public:
  TriangleJudge(const SolidMeshRequest& request, const CasterTree& tree) : request_(request), tree_(tree) {}

  /// Corners, as bits, that have to move; 0 where the triangle is proved or not contradicted by any point.
  using Faults = std::vector<std::uint8_t>;
  struct Surface {
    std::span<const Vec3> positions;
    std::span<const IndexedTriangle> triangles;
  };
  /// Corners, middles of sides and of triangles are tried, each once, but for those that are known. Of an umbra. `known`: what is
  /// known to have no fault before, and then after. `evaluations` grows by the points.
  Faults try_middles(const Surface& surface, TrianglePoints::Known& known, std::size_t& evaluations) const;
  /// Shafts are tried; where they prove nothing of an umbra, points of the triangles with the same corners among `grown`: a
  /// lattice that divides their sides into `parts`.
  Faults try_proofs(const Surface& surface, std::span<const Vec3> grown, int parts,
                    std::size_t& evaluations) const;
  /// One a triangle: it is proved. `depth`: see HiddenProof.
  std::vector<char> prove(const Surface& surface, int depth) const;

 private:
  const SolidMeshRequest& request_;
  const CasterTree& tree_;
};

/// Moves vertices along their edges, and grid points to the other side, until no triangle has a fault. Grid points of the
/// umbra only ever leave it, those of the penumbra only ever join it, so that it ends. `progress` is told about how far it is.
GridSurface carve(SolidGrid& grid, CrossedEdges& edges, const SolidMeshRequest& request,
                  const TriangleJudge& judge, std::size_t& evaluations, const Progress& progress);

}  // namespace penumbra::detail
