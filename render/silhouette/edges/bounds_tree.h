// Bounds of eight neighboring blocks of edges a node, and a tree of them.
//
// In: for each block of eight edges its box, and of their faces' planes a box of normals and the range of
// values at the middle. Out: a tree of eight children a node, in float with the margins of
// block_bounds.h; eight siblings are tested at once, and lists name them by their parent and a mask.
#pragma once

#include <bit>
#include <cstdint>
#include <utility>
#include <vector>

#include "render/silhouette/edges/band_edge.h"
#include "render/silhouette/edges/block_bounds.h"
#include "render/support/large_array.h"

namespace penumbra::detail {

/// Some of eight siblings: bit i of `kept` is child 8 parent + i.
struct NodeMask {
  std::uint32_t parent;
  std::uint32_t kept;
};

/// Calls visit(block) for every one.
template <class List, class Visit>
void for_each_block(const List& list, const Visit& visit) {
  for (const NodeMask& s : list)
    for (std::uint32_t kept = s.kept; kept != 0; kept &= kept - 1)
      visit(std::size_t{s.parent} * kFloatLanes + static_cast<std::size_t>(std::countr_zero(kept)));
}

/// How many blocks.
std::size_t count_blocks(const std::vector<NodeMask>& list);

/// What is known of a block, or of several together. An edge with one face only has no side: `near` is
/// infinite then.
struct BlockBounds {
  Vec3 low, high;                ///< of the edges
  Vec3 normal_low, normal_high;  ///< of their faces' planes
  double near_low, near_high;    ///< of the planes' values at the box's middle, tolerance included
};

/// Leaves of `in` what the test does not drop; returns how many there are. Every test has one such function,
/// compiled for several instruction sets.
std::size_t keep(const SidesTest& test, const Children* nodes, const NodeMask* in, std::size_t count,
                 NodeMask* out);
template <class Test>
PENUMBRA_INLINE std::size_t keep_with(const Test& test, const Children* nodes, const NodeMask* in,
                                      std::size_t count, NodeMask* out) {
  std::size_t found = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const NodeMask s = in[i];
    const std::uint32_t kept = s.kept & ~test.dropped(nodes[s.parent]);
    out[found] = {s.parent, kept};
    found += kept != 0 ? 1 : 0;
  }
  return found;
}

/// Of one edge or more.
BlockBounds bounds_of_edges(const BandEdge* first, const BandEdge* last);

class BoundsTree {
 public:
  static constexpr std::size_t kFanOut = kFloatLanes;

  BoundsTree() = default;
  /// `extent`: the largest coordinate. Cost O(blocks), on all cores.
  BoundsTree(std::vector<BlockBounds> blocks, double extent);
  bool empty() const { return levels_.empty(); }
  const Bounds& box() const { return box_; }
  double extent() const { return extent_; }
  /// Blocks that the test does not drop, nor what they lie in, ascending.
  template <class Test>
  void collect(const Test& test, std::vector<NodeMask>& out) const;
  /// Blocks whose groups of eight the test does not drop, as many as `collect` finds or more.
  template <class Test>
  std::size_t count_at_most(const Test& test) const;
  /// Of these blocks those that the test does not drop.
  void narrow(const std::vector<NodeMask>& list, const SidesTest& test, std::vector<NodeMask>& out) const;
  /// Bounds of the blocks, by their parents.
  const Children* blocks() const { return levels_.empty() ? nullptr : levels_[0].data(); }
  std::size_t bytes() const;

 private:
  template <class Test>
  void collect_down_to(std::size_t last, const Test& test, std::vector<NodeMask>& out) const;

  double extent_ = 1.0;
  Bounds box_;
  std::vector<LargeArray<Children>> levels_;  ///< blocks first
};

template <class Test>
void BoundsTree::collect(const Test& test, std::vector<NodeMask>& out) const {
  collect_down_to(0, test, out);
}

template <class Test>
std::size_t BoundsTree::count_at_most(const Test& test) const {
  if (levels_.size() < 2) return levels_.size() * kFanOut;
  std::vector<NodeMask> groups;
  collect_down_to(1, test, groups);
  return count_blocks(groups) * kFanOut;
}

template <class Test>
void BoundsTree::collect_down_to(std::size_t last, const Test& test, std::vector<NodeMask>& out) const {
  constexpr std::uint32_t kAll = (1u << kFanOut) - 1;
  out.clear();
  if (levels_.empty()) return;
  std::vector<NodeMask> kept;
  out.push_back({0, kAll});
  for (std::size_t level = levels_.size(); level-- > last;) {
    kept.resize(out.size());
    kept.resize(keep(test, levels_[level].data(), out.data(), out.size(), kept.data()));
    if (level == last) return std::swap(out, kept);
    out.clear();
    for (const NodeMask& s : kept)
      for (std::uint32_t bits = s.kept; bits != 0; bits &= bits - 1)
        out.push_back({s.parent * static_cast<std::uint32_t>(kFanOut) +
                           static_cast<std::uint32_t>(std::countr_zero(bits)),
                       kAll});
  }
}

}  // namespace penumbra::detail
