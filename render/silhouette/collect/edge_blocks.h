// Silhouette method, between steps 2 and 3: of whole blocks of edges those that are a silhouette for a receiver.
//
// In: blocks (band_tree.h) and a receiver. Out: the same as `test_edges` (edge_list.h)
// finds, for lists too long to be laid out tile by tile. Blocks are dropped first (ConeTest,
// block_tests.h). Then the planes' values at x are summed in float, from the light's center: an edge is
// dismissed where both faces keep their sides by the planes' tolerances and 2^-20 of the sum's terms, and the
// jump is 0. Whether it meets the disk is left to step 3.
#pragma once

#include <vector>

#include "render/silhouette/collect/band_tree.h"
#include "render/silhouette/collect/edge_list.h"
#include "render/silhouette/edges/plane_lanes.h"

namespace penumbra::detail {

class EdgeBlocks {
 public:
  /// The band in the order of its tree; it must outlive this. Cost O(E), on all cores.
  explicit EdgeBlocks(const Band& band);

  /// Of the list's edges those that the shaft's receivers may have to look at, by their indices in the band,
  /// ascending: all but those whose faces keep their sides for all receivers, or that the shaft misses. Cost
  /// O(edges of the list). Compiled for several instruction sets with the same result.
  void collect(const std::vector<NodeMask>& list, const Shaft& shaft, std::vector<std::uint32_t>& out) const;
  /// Edges by their indices in the band, ascending; false where more than `most` blocks would have to be
  /// looked into. Cost: some 5 flops an edge of the list, 13 of those blocks that are not dropped. Compiled
  /// for several instruction sets with the same result.
  bool test_edges(const BandTree& tree, const std::vector<NodeMask>& list, const TileReceiver& receiver,
                  std::size_t most, TestedEdges& out) const;
  std::size_t count() const { return blocks_.size(); }
  /// Of edge `i`, 0: dismissed, else its jump. Tests compare with it.
  int test_edge(std::size_t i, const Vec3& x) const;

  const Band& band() const { return band_; }
  std::size_t bytes() const { return blocks_.size() * sizeof(EdgePlanes); }

 private:
  const Band& band_;
  LargeArray<EdgePlanes> blocks_;
};

}  // namespace penumbra::detail
