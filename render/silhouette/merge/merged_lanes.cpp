#include "render/silhouette/merge/merged_lanes.h"

#include "render/silhouette/edges/block_bounds.h"

namespace penumbra::detail {
namespace {

/// A radius or margin that no distance is smaller than.
constexpr float kNowhere = -1e30f;

void set(std::array<Floats, 3>& to, std::size_t lane, const Vec3& p) {
  for (int k = 0; k < 3; ++k) to[k][lane] = static_cast<float>(p[k]);
}

void set(MergedLanes::Side& to, std::size_t lane, const MergedSides::Side& side, double grain) {
  set(to.center, lane, side.center);
  to.reach[lane] = side.is_flat ? kNowhere : enlarged(2.0 * side.radius, grain);
}

}  // namespace

MergedLanes::MergedLanes(const MergedBlock& block, double extent) {
  const double grain = kBoundsGrain * extent;
  for (std::size_t lane = 0; lane < kFloatLanes; ++lane) {
    const bool is_edge = lane < block.count;
    set(a, lane, is_edge ? block.edges[lane].a : Vec3(0.0));
    set(b, lane, is_edge ? block.edges[lane].b : Vec3(0.0));
    margin[lane] = is_edge ? enlarged(block.sides[lane].margin, grain) : kNowhere;
    set(left, lane, is_edge ? block.sides[lane].left : MergedSides::Side{}, grain);
    set(right, lane, is_edge ? block.sides[lane].right : MergedSides::Side{}, grain);
  }
}

}  // namespace penumbra::detail
