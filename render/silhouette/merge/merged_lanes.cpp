#include "render/silhouette/merge/merged_lanes.h"

#include <algorithm>
#include <cmath>

#include "render/silhouette/edges/block_bounds.h"

namespace penumbra::detail {
namespace {

/// A radius or margin that no distance is smaller than.
constexpr float kNowhere = -1e30f;

void set(std::array<Floats, 3>& to, std::size_t lane, const Vec3& p) {
  for (int k = 0; k < 3; ++k) to[k][lane] = static_cast<float>(p[k]);
}

/// Of one side: its plane, what it stands for, what of it may be mistaken.
void set(MergedLanes::Side& to, std::size_t lane, const BandEdge& edge, const FacePlane& plane,
         const MergedSides::Side& side, const MergedFaults::Side& faults, double grain) {
  const bool is_patch = side.radius > 0.0;
  set(to.center, lane, is_patch ? side.center : edge.a);
  to.reach[lane] = side.is_flat ? kNowhere : enlarged(2.0 * side.radius, grain);
  set(to.normal, lane, plane.normal);
  to.tilt[lane] = enlarged(side.tilt, 0.0);
  // A face without area looks nowhere, and rounding of its points and normal changes its plane.
  to.spread[lane] = enlarged(side.spread + std::abs(plane.tolerance), grain);
  to.area[lane] = static_cast<float>((1.0 - 0x1p-20) * faults.area);
  to.shifted[lane] = enlarged(faults.shifted, 0.0);
  const glm::dmat3& t = faults.turned;
  to.trace[lane] = enlarged(std::sqrt(std::max(0.0, t[0][0] + t[1][1] + t[2][2])), 0.0);
  for (int row = 0, k = 0; row < 3; ++row)
    for (int column = row; column < 3; ++column, ++k) to.turned[k][lane] = static_cast<float>(t[row][column]);
}

}  // namespace

MergedLanes::MergedLanes(const MergedBlock& block, double extent) : is_exact(true) {
  const double grain = kBoundsGrain * extent;
  for (std::size_t lane = 0; lane < kFloatLanes; ++lane) {
    const bool is_edge = lane < block.count;
    static const FacePlane none{Vec3(0.0), 0.0, 0.0};
    const BandEdge edge = is_edge ? block.edges[lane] : BandEdge{Vec3(0.0), Vec3(0.0), none, none};
    const MergedSides sides = is_edge ? block.sides[lane] : MergedSides{};
    const MergedFaults faults = is_edge ? block.faults[lane] : MergedFaults{};
    set(a, lane, edge.a);
    set(b, lane, edge.b);
    margin[lane] = is_edge ? enlarged(sides.margin, grain) : kNowhere;
    set(left, lane, edge, edge.left, sides.left, faults.left, grain);
    set(right, lane, edge, edge.right, sides.right, faults.right, grain);
    swept[lane] = enlarged(faults.swept, 0.0);
    swept_at_any[lane] = enlarged(faults.swept_at_any, 0.0);
    stray[lane] = enlarged(faults.stray, 0.0);
    set(middle, lane, sides.middle);
    for (int k = 0; k < 3; ++k) half[k][lane] = enlarged(sides.half[k], grain);
    is_exact = is_exact && !(faults.swept > 0.0) && !(faults.swept_at_any > 0.0) &&
               !(left.trace[lane] > 0.0f) && !(right.trace[lane] > 0.0f) && !(left.shifted[lane] > 0.0f) &&
               !(right.shifted[lane] > 0.0f);
  }
}

}  // namespace penumbra::detail
