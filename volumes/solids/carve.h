// Solids: a surface on grid edges is moved to the safe side, triangle by triangle.
#pragma once

#include "volumes/solids/caster_tree.h"
#include "volumes/solids/grid_surface.h"
#include "volumes/solids/solid_mesher.h"

namespace penumbra::detail {

/// What triangles are judged by: shafts, and for the umbra points where shafts prove nothing. Refers to its arguments.
class TriangleJudge {
 public:
  TriangleJudge(const SolidMeshRequest& request, const CasterTree& tree) : request_(request), tree_(tree) {}

  struct Verdict {
    bool proved = false;
    bool good = false;  ///< proved, or not contradicted by any point
  };
  using Triangle = std::array<Vec3, 3>;
  /// On all threads. `thorough`: else those of an umbra are judged by few points alone. `evaluations` grows by the points that
  /// were judged.
  std::vector<Verdict> judge(std::span<const Triangle> triangles, bool thorough,
                             std::size_t& evaluations) const;

 private:
  void prove(std::span<const Triangle> triangles, std::vector<Verdict>& out) const;

  const SolidMeshRequest& request_;
  const CasterTree& tree_;
};

/// Moves vertices along their edges, and grid points to the other side, until no triangle is judged bad. Grid points of the
/// umbra only ever leave it, those of the penumbra only ever join it, so that it ends. `progress` is told the share of
/// triangles that are good.
GridSurface carve(SolidGrid& grid, CrossedEdges& edges, const SolidMeshRequest& request,
                  const TriangleJudge& judge, std::size_t& evaluations, const Progress& progress);

}  // namespace penumbra::detail
