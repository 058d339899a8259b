// Silhouette method, step collect: the certificate for merged edges.
//
// In: a band of merged edges (merge/merged_edges.h), a tile's receivers, and a spot of the disk: all of it,
// or one point. Out: whether some edge may stand for a silhouette across the spot although it is none itself.
// For a receiver it certainly does not where
//  - what it stands for lies beside the spot, or below the receiver's tangent plane, or
//  - the faces of both sides look the same way.
// Where no edge does for all of the disk, nothing crosses the disk. Where no edge does for a point, the
// number of faces before the point is what merged edges make of it, so that one ray to it tells the numbers
// elsewhere.
//
// Few edges leave that open for a tile, and fewer for a part of it. They are looked for only when they are
// first asked for.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/silhouette/collect/light_band.h"
#include "render/silhouette/collect/merged_edge_tests.h"
#include "render/silhouette/collect/shaft.h"

namespace penumbra::detail {

/// For one tile after the other, with memory kept between them.
class UncertainEdges {
 public:
  /// Begins a tile, given by its list of blocks of the band and its shaft. Refers to all three.
  void begin_tile(const Band& band, const std::vector<NodeMask>& list, const Shaft& shaft);
  /// Begins a part of the tile: some of its receivers that lie close together. Refers to them. Without any,
  /// edges are not looked for part by part: for few questions about the tile.
  void begin_part(std::span<const TileReceiver> part);
  /// Whether no edge of the list can stand for a silhouette across the spot, by `slack`
  /// (certificate_slack). `receiver` is one of the part's, or without a part of the tile's.
  bool are_none(const TileReceiver& receiver, const DiskSpot& spot, double slack);

 private:
  /// Some edges of a block, as bits.
  struct EdgesOfBlock {
    std::int32_t block;
    std::uint32_t edges;
  };
  /// The edges that the tile's shaft leaves open, and of these the part's.
  void collect();
  void narrow();
  /// Appends those of some edges of a block that a shaft leaves open.
  void add(std::int32_t block, std::uint32_t edges, const Shaft& shaft, const FloatShaft& in_float,
           std::vector<EdgesOfBlock>& out) const;

  const Band* band_ = nullptr;
  const std::vector<NodeMask>* list_ = nullptr;
  const Shaft* shaft_ = nullptr;
  std::span<const TileReceiver> part_;
  bool collected_ = false, narrowed_ = false;
  std::vector<EdgesOfBlock> of_tile_, of_part_;
};

/// Whether merged edge i certainly stands for no silhouette across the spot. An edge that stands for nothing
/// but itself does so for all of the disk only: for a point it is known what it does.
bool is_certainly_no_silhouette(const Band& band, std::size_t i, const TileReceiver& receiver,
                                const DiskSpot& spot, double slack);

}  // namespace penumbra::detail
