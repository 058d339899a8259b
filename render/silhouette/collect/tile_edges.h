// Silhouette method, step collect, for other methods: the edges of a band that each receiver of a tile may
// have to look at.
//
// In: a band, up to 64 receivers that lie close together. Out: a list of edges for each receiver, short
// enough to go over. Left out is what lies beside the light for the receiver and those around it, what is
// below all their horizons, and edges whose jump is 0 for all of them (shaft.h).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/silhouette/collect/band_tree.h"
#include "render/silhouette/collect/edge_blocks.h"
#include "render/silhouette/collect/edge_list.h"
#include "render/silhouette/collect/tile_receivers.h"

namespace penumbra::detail {

/// What one thread keeps between tiles.
struct TileEdgesMemory {
  std::vector<NodeMask> blocks;
  std::vector<std::uint32_t> edges;
  EdgeList list, part_list;
};

class TileEdges {
 public:
  /// Refers to the band. Cost O(E), on all cores.
  explicit TileEdges(const Band& band);

  /// Calls `visit(receiver, list)` for each receiver; they change their order. Returns false, with nothing
  /// called, where no caster's box reaches between the tile and the light.
  template <class Visit>
  bool for_each(std::span<TileReceiver> tile, TileEdgesMemory& memory, const Visit& visit) const {
    if (tile.empty() || !collect(tile, memory)) return false;
    divide(tile, memory, visit);
    return true;
  }
  std::size_t bytes() const { return tree_.bytes() + blocks_.bytes(); }

 private:
  // Speed. Shorter lists are not narrowed for parts of a tile, and longer ones for so many receivers at a
  // time.
  static constexpr std::size_t kShortList = 24, kFewReceivers = 16;

  bool collect(std::span<const TileReceiver> tile, TileEdgesMemory& memory) const;
  /// Narrows the tile's list for a part of the tile.
  void narrow_for(std::span<const TileReceiver> part, TileEdgesMemory& memory) const;
  template <class Visit>
  void divide(std::span<TileReceiver> part, TileEdgesMemory& memory, const Visit& visit) const {
    const bool is_short = memory.list.size() <= kShortList;
    if (!is_short && part.size() > kFewReceivers) {
      const std::size_t middle = halve(part);
      divide(part.first(middle), memory, visit);
      return divide(part.subspan(middle), memory, visit);
    }
    if (!is_short) narrow_for(part, memory);
    for (const TileReceiver& receiver : part) visit(receiver, is_short ? memory.list : memory.part_list);
  }

  const Band& band_;
  const BandTree tree_;
  const EdgeBlocks blocks_;
};

/// The edges of a list that may be silhouettes near the disk for a receiver: calls `visit(edge)`. Floats
/// dismiss most edges of a long list.
template <class Visit>
void for_each_near(const EdgeList& list, const Vec3& x, TestedEdges& memory, const Visit& visit) {
  constexpr std::size_t kFewEdges = 6;  // speed: so few are not tested before
  if (list.size() <= kFewEdges) {
    for (std::size_t i = 0; i < list.size(); ++i) visit(list.edge(list.place(i)));
    return;
  }
  test_edges(list, x, memory);
  for (std::size_t i = 0; i < memory.count; ++i) visit(list.edge(memory.places[i]));
}

}  // namespace penumbra::detail
