// Silhouette method, step edges: a tree of bounds over blocks of eight edges.
//
// In: for each block the box of its edges, the box of its faces' normals and the range of its planes'
// values at the middle. Out: a tree with eight children a node. A test is run from the top; what it drops
// at a node it drops for all that lies below. Eight children are tested at once, in float with the margins
// of block_bounds.h. Lists name the blocks that are left by their parent and a mask (`NodeMask`).
//
// A test is a class with `std::uint32_t dropped(const Children&) const`, bit i set where child i is
// dropped, and a function `keep` of its own.
#pragma once

#include <bit>
#include <cstdint>
#include <utility>
#include <vector>

#include "render/silhouette/edges/band_edge.h"
#include "render/silhouette/edges/block_bounds.h"
#include "render/support/large_array.h"

namespace penumbra::detail {

/// Some of the eight children of a node: bit i of `kept` stands for child 8 parent + i.
struct NodeMask {
  std::uint32_t parent;
  std::uint32_t kept;
};

/// Calls visit(block) for every block of a list, ascending if the list is.
template <class List, class Visit>
void for_each_block(const List& list, const Visit& visit) {
  for (const NodeMask& s : list)
    for (std::uint32_t kept = s.kept; kept != 0; kept &= kept - 1)
      visit(std::size_t{s.parent} * kFloatLanes + static_cast<std::size_t>(std::countr_zero(kept)));
}

/// How many blocks a list has.
std::size_t count_blocks(const std::vector<NodeMask>& list);

/// The bounds of a block, or of several together.
struct BlockBounds {
  /// The box of the edges.
  Vec3 low, high;
  /// The box of their faces' normals.
  Vec3 normal_low, normal_high;
  /// The range of the planes' values at the middle of the box, tolerances included. Infinite where an edge
  /// has one face only: such an edge has no side.
  double near_low, near_high;
};

/// Writes to `out` those children of the list `in` that the test does not drop, and returns how many
/// entries that are. Every test has one such function, compiled for several instruction sets with the same
/// result.
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

/// Bounds of the edges first to last, at least one.
BlockBounds bounds_of_edges(const BandEdge* first, const BandEdge* last);

class BoundsTree {
 public:
  static constexpr std::size_t kFanOut = kFloatLanes;

  BoundsTree() = default;
  /// `extent`: the largest coordinate, light radii or what unit the frame has. Cost O(blocks), on all cores.
  BoundsTree(std::vector<BlockBounds> blocks, double extent);
  bool empty() const { return levels_.empty(); }
  const Bounds& box() const { return box_; }
  double extent() const { return extent_; }
  /// The blocks that the test drops neither themselves nor with a node above, ascending. Replaces `out`.
  template <class Test>
  void collect(const Test& test, std::vector<NodeMask>& out) const;
  /// How many blocks lie in groups of eight that the test does not drop: as many as `collect` finds, or more.
  template <class Test>
  std::size_t count_at_most(const Test& test) const;
  /// The blocks of a list that the test does not drop. Replaces `out`.
  void narrow(const std::vector<NodeMask>& list, const SidesTest& test, std::vector<NodeMask>& out) const;
  /// The bounds of blocks 8 i to 8 i + 7 are entry i. Null for a tree without blocks.
  const Children* blocks() const { return levels_.empty() ? nullptr : levels_[0].data(); }
  std::size_t bytes() const;

 private:
  /// `collect` that stops at a level, 0 for the blocks.
  template <class Test>
  void collect_down_to(std::size_t last, const Test& test, std::vector<NodeMask>& out) const;

  double extent_ = 1.0;
  Bounds box_;
  /// The levels of the tree, from the blocks up.
  std::vector<LargeArray<Children>> levels_;
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
