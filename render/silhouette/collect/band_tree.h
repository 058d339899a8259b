// Silhouette method, step collect: a tree over the band, and which of its blocks receivers have to look at.
//
// In: the band. Out: a tree of bounds over blocks of eight edges, neighbors in the band's order
// (edges/bounds_tree.h). A block is dropped whole where its faces are all seen from the front, or all from
// behind. So on a fine surface the edges that are looked at follow the silhouette.
//
// A block is dropped for a tile where it lies outside of the tile's shaft (shaft.h), below all horizons, or
// where the planes of all its faces have one sign for all receivers.
#pragma once

#include <span>
#include <vector>

#include "render/silhouette/collect/block_tests.h"
#include "render/silhouette/edges/bounds_tree.h"

namespace penumbra::detail {

std::size_t keep(const ShaftTest& test, const Children* nodes, const NodeMask* in, std::size_t count,
                 NodeMask* out);

class BandTree {
 public:
  static constexpr std::size_t kFanOut = BoundsTree::kFanOut;

  /// Block i has edges 8 i to 8 i + 7. Cost O(E), on all cores.
  explicit BandTree(const Band& band);
  /// True only if `collect` finds nothing; decided by the box of the whole band.
  bool misses(const Shaft& shaft) const;
  /// The blocks that some receiver of the shaft may have to look at, ascending. Replaces `out`.
  void collect(const Shaft& shaft, std::vector<NodeMask>& out) const;
  /// The blocks of a list whose planes do not all have one sign for all of some receivers. Replaces `out`.
  /// Cost: some 30 flops a block.
  void narrow(const std::vector<NodeMask>& list, std::span<const TileReceiver> receivers,
              std::vector<NodeMask>& out) const;
  /// As BoundsTree::blocks.
  const Children* blocks() const { return tree_.blocks(); }
  double extent() const { return tree_.extent(); }
  std::size_t bytes() const { return tree_.bytes(); }

 private:
  BoundsTree tree_;
};

}  // namespace penumbra::detail
