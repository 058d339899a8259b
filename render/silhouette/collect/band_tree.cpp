#include "render/silhouette/collect/band_tree.h"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace penumbra::detail {
namespace {

// Speed. Seen in the benchmark `silhouette`, stage band_tree.
constexpr std::size_t kBlocksPerTask = 512;

std::vector<BlockBounds> bounds_of_blocks(const Band& band) {
  if (band.is_merged()) return band.bounds;
  constexpr std::size_t kEdges = BandTree::kFanOut;
  std::vector<BlockBounds> out((band.edges.size() + kEdges - 1) / kEdges);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, out.size(), kBlocksPerTask), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i)
      out[i] = bounds_of_edges(band.edges.data() + i * kEdges,
                               band.edges.data() + std::min((i + 1) * kEdges, band.edges.size()));
  });
  return out;
}

}  // namespace

PENUMBRA_VECTOR_CLONES
std::size_t keep(const ShaftTest& test, const Children* nodes, const NodeMask* in, std::size_t count,
                 NodeMask* out) {
  return keep_with(test, nodes, in, count, out);
}

BandTree::BandTree(const Band& band) : tree_(bounds_of_blocks(band), band.extent) {}

bool BandTree::misses(const Shaft& shaft) const {
  return tree_.empty() || shaft.misses(tree_.box().low, tree_.box().high);
}

void BandTree::collect(const Shaft& shaft, std::vector<NodeMask>& out) const {
  tree_.collect(ShaftTest(shaft, tree_.extent()), out);
}

void BandTree::narrow(const std::vector<NodeMask>& list, std::span<const TileReceiver> receivers,
                      std::vector<NodeMask>& out) const {
  Bounds box;
  for (const TileReceiver& r : receivers) box.add(r.x);
  tree_.narrow(list, SidesTest(box.center(), 0.5 * (box.high - box.low)), out);
}

}  // namespace penumbra::detail
