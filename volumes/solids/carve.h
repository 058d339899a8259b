// Solids: a surface on grid edges is moved to the safe side, triangle by triangle.
#pragma once

#include <tbb/enumerable_thread_specific.h>

#include "volumes/solids/grid_surface.h"
#include "volumes/solids/shafts/caster_tree.h"
#include "volumes/solids/shafts/hidden_proof.h"
#include "volumes/solids/solid_mesher.h"
#include "volumes/solids/triangle_points.h"

namespace penumbra::detail {

/// What triangles are judged by: shafts, and for the umbra points where shafts prove nothing. Refers to its
/// arguments.
class TriangleJudge {
 public:
  TriangleJudge(const SolidMeshRequest& request, const CasterTree& tree)
      : request_(request), tree_(tree), proofs_([&] { return HiddenProof(tree_, request_.light); }) {}

  TriangleJudge(const TriangleJudge&) = delete;
  TriangleJudge& operator=(const TriangleJudge&) = delete;

  /// Corners, as bits, that have to move; 0 where no point of the triangle has a fault.
  using Faults = std::vector<std::uint8_t>;
  struct Surface {
    std::span<const Vec3> positions;
    std::span<const IndexedTriangle> triangles;
  };
  /// Points of an umbra's triangles are tried, each once, but for those that are known to have no fault.
  /// `known`: before, and then after. `evaluations` grows by the points.
  Faults try_points(const Surface& surface, const PointPattern& pattern, TrianglePoints::Known& known,
                    std::size_t& evaluations) const;
  /// One a triangle: it is proved. `effort`: of an umbra.
  std::vector<char> prove(const Surface& surface, const HiddenProof::Effort& effort) const;

 private:
  std::vector<char> prove_hidden(const Surface& surface, const HiddenProof::Effort& effort) const;
  std::vector<char> prove_lit(const Surface& surface) const;

  const SolidMeshRequest& request_;
  const CasterTree& tree_;
  mutable tbb::enumerable_thread_specific<HiddenProof> proofs_;
};

/// Moves vertices along their edges, and grid points to the other side, until no triangle has a fault. Grid
/// points of the umbra only ever leave it, those of the penumbra only ever join it, so that it ends.
/// `progress` is told about how far it is.
GridSurface carve(SolidGrid& grid, CrossedEdges& edges, const SolidMeshRequest& request,
                  const TriangleJudge& judge, std::size_t& evaluations, const Progress& progress);

}  // namespace penumbra::detail
