// Silhouette method, the certificate again, for merged edges (merged_edges.h): which of them may stand for a
// silhouette across the disk although they are none themselves.
//
// In: a band of merged edges, receivers. Out: whether what an edge stands for is none for a receiver for
// certain: its sides' faces look the same way, or what is seen of them lies beside the disk or below the
// receiver's tangent plane. Few edges leave that open for a tile, and for parts of a tile fewer: they are
// looked for when first asked for, since most receivers see an edge or have none near.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/silhouette/collect/edge_list.h"
#include "render/silhouette/merge/merged_lanes.h"

namespace penumbra::detail {

/// For one tile after the other, with memory kept between them.
class UncertainEdges {
 public:
  /// A tile, by its list of blocks of the band's edges and its shaft; all three are referred to.
  void begin_tile(const Band& band, const std::vector<NodeMask>& list, const Shaft& shaft);
  /// Some of the tile's receivers that lie close together: the next ones to be asked for.
  void begin_part(std::span<const TileReceiver> part);
  /// Whether no edge of the list stands for a silhouette across the disk, with the certificate's slack;
  /// `receiver` is one of the part's.
  bool are_none(const TileReceiver& receiver, double slack);

 private:
  /// Some edges of a block, as bits.
  struct EdgesOfBlock {
    std::int32_t block;
    std::uint32_t edges;
  };
  void collect();
  void narrow();
  /// What of them is left for a shaft.
  void add(std::int32_t block, std::uint32_t edges, const Shaft& shaft, const FloatShaft& in_float,
           std::vector<EdgesOfBlock>& out) const;

  const Band* band_ = nullptr;
  const std::vector<NodeMask>* list_ = nullptr;
  const Shaft* shaft_ = nullptr;
  std::span<const TileReceiver> part_;
  bool collected_ = false, narrowed_ = false;
  std::vector<EdgesOfBlock> of_tile_, of_part_;
};

/// Of one merged edge.
bool is_certainly_no_silhouette(const Band& band, std::size_t i, const TileReceiver& receiver, double slack);

}  // namespace penumbra::detail
