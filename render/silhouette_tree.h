// Accurate rung, in step 2: a hierarchy over the band, and which of its blocks a tile or a receiver looks at.
//
// In: the band. Out: over blocks of eight edges, neighbours along its curve, a tree of eight children a node.
// A node knows the box of its edges, and of their faces' planes a box of normals and the range of values at
// the middle. So, on a fine surface, what is looked at follows the silhouette: a block is dropped whole where
// its faces are all seen from the front, or all from behind.
//
// A block is dropped for a tile where it lies outside of the tile's shaft (silhouette_gather.h), below all
// horizons, or where the planes of all its faces have one sign for all receivers; silhouette_bounds.h has the
// margins.
//
// Eight siblings are tested at once; lists name them by their parent and a mask.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/silhouette_bounds.h"

namespace penumbra::detail {

/// Some of eight siblings: bit i of `kept` is child 8 parent + i.
struct Siblings {
  std::uint32_t parent;
  std::uint32_t kept;
};

class BandTree {
 public:
  static constexpr std::size_t kFanOut = kFloatLanes;

  /// Block i has edges 8 i and up. Cost O(E), on all cores.
  explicit BandTree(const Band& band);
  /// True where `gather` finds nothing for certain, by the whole band's box.
  bool misses(const Shaft& shaft) const;
  /// The blocks that some receiver of the shaft may have to look at, ascending.
  void gather(const Shaft& shaft, std::vector<Siblings>& out) const;
  /// Of these blocks those whose planes have not one sign for all of fewer receivers. Cost: some 30 flops a
  /// block.
  void narrow(const std::vector<Siblings>& list, std::span<const Receiver> receivers,
              std::vector<Siblings>& out) const;
  /// Bounds of the blocks, by their parents.
  const Children* blocks() const { return levels_.empty() ? nullptr : levels_[0].data(); }
  double extent() const { return extent_; }
  std::size_t bytes() const;

 private:
  struct Node;
  Node node_of(const Band& band, std::size_t first, std::size_t last) const;
  static Node joined(const Node* first, const Node* last);
  std::vector<Children> packed(const std::vector<Node>& nodes) const;

  double extent_ = 1.0;
  Bounds box_;
  std::vector<std::vector<Children>> levels_;  ///< blocks first
};

/// How many blocks.
std::size_t count_blocks(const std::vector<Siblings>& list);

}  // namespace penumbra::detail
