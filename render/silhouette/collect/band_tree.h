// Silhouette method, in step 2: a hierarchy over the band, and which of its blocks a tile or a receiver looks at.
//
// In: the band. Out: over blocks of eight edges, neighbors along its curve, a tree of eight children a node.
// A node knows the box of its edges, and of their faces' planes a box of normals and the range of values at
// the middle. So, on a fine surface, what is looked at follows the silhouette: a block is dropped whole where
// its faces are all seen from the front, or all from behind.
//
// A block is dropped for a tile where it lies outside of the tile's shaft (shaft.h), below all
// horizons, or where the planes of all its faces have one sign for all receivers; block_tests.h has the
// margins.
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

  /// Block i has edges 8 i and up. Cost O(E), on all cores.
  explicit BandTree(const Band& band);
  /// True where `collect` finds nothing for certain, by the whole band's box.
  bool misses(const Shaft& shaft) const;
  /// The blocks that some receiver of the shaft may have to look at, ascending.
  void collect(const Shaft& shaft, std::vector<NodeMask>& out) const;
  /// Of these blocks those whose planes have not one sign for all of fewer receivers. Cost: some 30 flops a
  /// block.
  void narrow(const std::vector<NodeMask>& list, std::span<const TileReceiver> receivers,
              std::vector<NodeMask>& out) const;
  /// Bounds of the blocks, by their parents.
  const Children* blocks() const { return tree_.blocks(); }
  double extent() const { return tree_.extent(); }
  std::size_t bytes() const { return tree_.bytes(); }

 private:
  BoundsTree tree_;
};

}  // namespace penumbra::detail
