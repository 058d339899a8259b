// Silhouette method, step collect: the edges of blocks that may be silhouettes, for a tile or for one
// receiver.
//
// In: a list of blocks (band_tree.h), and a tile's shaft or one receiver. Out: for a shaft the edges that
// some of its receivers may have to look at. For one receiver the edges that it has to look at, as
// edge_list.h finds them; this is for lists that are too long to be laid out tile by tile.
//
// For one receiver blocks are dropped first (ConeTest). Then the values of the planes at x are summed in
// float, from the light's center. An edge is dismissed where both values are beyond the planes' tolerances
// and 2^-20 of the terms of the sums, and its jump is 0. Whether it meets the disk is left to the next
// step.
#pragma once

#include <vector>

#include "render/silhouette/collect/band_tree.h"
#include "render/silhouette/collect/edge_list.h"
#include "render/silhouette/edges/plane_lanes.h"

namespace penumbra::detail {

class EdgeBlocks {
 public:
  /// Refers to the band. Cost O(E), on all cores.
  explicit EdgeBlocks(const Band& band);

  /// The edges that some receiver of the shaft may have to look at, by their indices in the band,
  /// ascending: all of the list but those whose faces are on the same sides for all receivers, and those
  /// that the shaft misses. Replaces `out`. Cost O(edges of the list). Compiled for several instruction
  /// sets with the same result.
  void collect(const std::vector<NodeMask>& list, const Shaft& shaft, std::vector<std::uint32_t>& out) const;
  /// The edges that a receiver has to look at, by their indices in the band, ascending, into `out`. Returns
  /// false, with nothing found, where more than `most` blocks are not dropped. Cost: some 5 flops an edge
  /// of the list, and 13 an edge of the blocks that are not dropped. Compiled for several instruction sets
  /// with the same result.
  bool test_edges(const BandTree& tree, const std::vector<NodeMask>& list, const TileReceiver& receiver,
                  std::size_t most, TestedEdges& out) const;
  /// How many blocks the band has.
  std::size_t count() const { return blocks_.size(); }
  /// The same for edge i of the band alone: 0 where it is dismissed, else its jump. For tests.
  int test_edge(std::size_t i, const Vec3& x) const;

  const Band& band() const { return band_; }
  std::size_t bytes() const { return blocks_.size() * sizeof(EdgePlanes); }

 private:
  const Band& band_;
  LargeArray<EdgePlanes> blocks_;
};

}  // namespace penumbra::detail
