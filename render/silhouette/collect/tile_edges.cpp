#include "render/silhouette/collect/tile_edges.h"

#include <algorithm>

namespace penumbra::detail {

TileEdges::TileEdges(const Band& band) : band_(band), tree_(band_), blocks_(band_) {}

bool TileEdges::collect(std::span<const TileReceiver> tile, TileEdgesMemory& memory) const {
  Shaft shaft(tile, band_.extent);
  if (std::ranges::none_of(band_.casters,
                           [&](const Bounds& box) { return !shaft.misses(box.low, box.high); }))
    return false;
  shaft.tighten(tile);
  tree_.collect(shaft, memory.blocks);
  blocks_.collect(memory.blocks, shaft, memory.edges);
  memory.list.assign(band_, memory.edges, shaft.middle());
  return true;
}

void TileEdges::narrow_for(std::span<const TileReceiver> part, TileEdgesMemory& memory) const {
  Shaft shaft(part, band_.extent);
  shaft.tighten(part);
  narrow(memory.list, shaft, memory.edges);
  memory.part_list.assign(memory.list, memory.edges);
}

}  // namespace penumbra::detail
