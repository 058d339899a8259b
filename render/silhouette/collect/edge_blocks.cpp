#include "render/silhouette/collect/edge_blocks.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>

namespace penumbra::detail {
namespace {

// Speed. Seen in the benchmark `silhouette`, stage band_tree.
constexpr std::size_t kBlocksPerTask = 512;

struct FloatPoint {
  explicit FloatPoint(const Vec3& p)
      : x(static_cast<float>(p.x)), y(static_cast<float>(p.y)), z(static_cast<float>(p.z)) {}
  float x, y, z;
};

/// The values of eight planes at a point.
PENUMBRA_INLINE void value_at(const FloatPoint& p, const PlaneLanes& plane, Floats& out) {
  out = plane.x * p.x + plane.y * p.y + plane.z * p.z + plane.offset;
}

/// The jumps of eight edges, or kUnsure; 0 where an edge is dismissed.
PENUMBRA_INLINE void jumps_of(const EdgePlanes& b, const FloatPoint& p, Ints& out) {
  Floats left, right;
  value_at(p, b.left, left);
  value_at(p, b.right, right);
  const Ints none{}, unsure = none + TestedEdges::kUnsure;
  const Ints sure = (magnitude(left) > b.left.tolerance) & (magnitude(right) > b.right.tolerance);
  // Comparisons are -1 where true.
  const Ints jump = -1 - 2 * (left > 0.0f) + (right > 0.0f) - (right < 0.0f);
  out = sure ? jump : unsure;
}

constexpr Ints kLaneNumbers{0, 1, 2, 3, 4, 5, 6, 7};

/// Writes the numbers of the blocks of a list that are not dropped, and returns how many. Up to seven more
/// are written.
PENUMBRA_VECTOR_CLONES
std::size_t keep_blocks(const Children* bounds, const NodeMask* list, std::size_t count, const ConeTest& cone,
                        std::int32_t* __restrict out) {
  std::size_t found = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const NodeMask s = list[i];
    const std::uint32_t kept = s.kept & ~cone.dropped(bounds[s.parent]);
    found += store_lanes(kLaneNumbers + static_cast<std::int32_t>(s.parent) * kFloatLanes, kept, out + found);
  }
  return found;
}

/// Writes the indices and the jumps of those edges of some blocks that are not dismissed, and returns how
/// many. Up to seven more are written.
PENUMBRA_VECTOR_CLONES
std::size_t test_blocks(const EdgePlanes* blocks, const std::int32_t* list, std::size_t count,
                        const FloatPoint& at, std::int32_t* __restrict places,
                        std::int32_t* __restrict jumps) {
  const FloatPoint p = at;
  std::size_t found = 0;
  for (std::size_t i = 0; i < count; ++i) {
    Ints jump;
    jumps_of(blocks[list[i]], p, jump);
    const std::uint32_t kept = bits_of(jump != 0);
    store_lanes(kLaneNumbers + list[i] * kFloatLanes, kept, places + found);
    found += store_lanes(jump, kept, jumps + found);
  }
  return found;
}

}  // namespace

EdgeBlocks::EdgeBlocks(const Band& band)
    : band_(band), blocks_((band.edges.size() + kFloatLanes - 1) / kFloatLanes) {
  const auto fill = [&](std::size_t block) {
    for (std::size_t lane = 0; lane < kFloatLanes; ++lane) {
      const std::size_t i = block * kFloatLanes + lane;
      if (i < band.edges.size())
        blocks_[block].set(lane, band.edges[i], band.extent);
      else
        blocks_[block].set_none(lane);
    }
  };
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, blocks_.size(), kBlocksPerTask),
                    [&](const auto& range) {
                      for (std::size_t i = range.begin(); i < range.end(); ++i) fill(i);
                    });
}

void EdgeBlocks::collect(const std::vector<NodeMask>& list, const Shaft& shaft,
                         std::vector<std::uint32_t>& out) const {
  out.clear();
  const FloatBox receivers(shaft.middle(), shaft.half());
  for_each_block(list, [&](std::size_t block) {
    for (std::uint32_t edges = may_be_silhouettes(blocks_[block], receivers); edges != 0;
         edges &= edges - 1) {
      const std::size_t i = block * kFloatLanes + static_cast<std::size_t>(std::countr_zero(edges));
      if (!shaft.misses(band_.edges[i])) out.push_back(static_cast<std::uint32_t>(i));
    }
  });
}

bool EdgeBlocks::test_edges(const BandTree& tree, const std::vector<NodeMask>& list,
                            const TileReceiver& receiver, std::size_t most, TestedEdges& out) const {
  const auto at_least = [](auto& buffer, std::size_t size) { buffer.resize(std::max(buffer.size(), size)); };
  at_least(out.blocks, (list.size() + 1) * kFloatLanes);
  out.looked_into = keep_blocks(tree.blocks(), list.data(), list.size(), ConeTest(receiver, tree.extent()),
                                out.blocks.data());
  if (out.looked_into > most) return false;
  at_least(out.places, (out.looked_into + 1) * kFloatLanes);
  at_least(out.jumps, out.places.size());
  out.count = test_blocks(blocks_.data(), out.blocks.data(), out.looked_into, FloatPoint(receiver.x),
                          out.places.data(), out.jumps.data());
  return true;
}

int EdgeBlocks::test_edge(std::size_t i, const Vec3& x) const {
  Ints jump;
  jumps_of(blocks_[i / kFloatLanes], FloatPoint(x), jump);
  return jump[i % kFloatLanes];
}

}  // namespace penumbra::detail
