#include "render/silhouette/passes.h"

namespace penumbra::detail {
namespace {

// Of the edges that may be in the band, at most, where merged ones are looked at.
constexpr double kMostMerged = 0.125;
constexpr double kMostMergedFlat = 0.5;  // the same for what is flat: never wrong, and never tried in vain

constexpr std::size_t kInRegion = 4;  // receivers

}  // namespace

/// Levels that leave most of the band's edges are no help.
Passes make_passes(const LitScene& lit, const SceneEdges& edges, const MergedEdges* merged, double tolerance,
                   std::size_t receivers) {
  Passes out;
  if (!merged || merged->levels().empty() || !lit.all_in_front || lit.light.is_projective()) return out;
  out.band_size = edges.size_of_band(lit.light.light());
  const auto size = static_cast<double>(out.band_size);
  for (auto at = merged->levels().rbegin(); at != merged->levels().rend(); ++at) {  // coarsest first
    const MergedLevel& level = *at;
    const double in_radii = level.deviation * lit.light.per_radius();
    if (in_radii > tolerance) continue;
    const std::size_t blocks = merged->blocks_of(level, lit.light.light(), lit.cannot_occlude).size();
    const double worth = level.deviation > 0.0 ? kMostMerged : kMostMergedFlat;
    if (static_cast<double>(blocks * MergedBlock::kEdges) > worth * size) break;
    out.levels.push_back(&level);
    out.deviation.push_back(in_radii);
  }
  if (!out.levels.empty()) out.of.resize(receivers);
  return out;
}

std::vector<ReceiverRegion> regions_of(const std::vector<std::uint32_t>& tiles, const Passes& passes,
                                       const ReceiverSource& source, const UnitLight& light,
                                       const RayFrame& frame) {
  std::vector<std::vector<ReceiverRegion>> of_tiles(tiles.size());
  tbb::parallel_for(std::size_t{0}, tiles.size(), [&](std::size_t i) {
    std::vector<TileReceiver> receivers;
    source.collect(tiles[i], receivers);
    std::erase_if(receivers, [&](const TileReceiver& r) { return passes.of[r.index] != passes.now; });
    const auto add = [&](const auto& self, std::span<TileReceiver> part) -> void {
      if (part.size() > kInRegion) {
        const std::size_t middle = halve(part);
        self(self, part.first(middle));
        return self(self, part.subspan(middle));
      }
      Shaft shaft(part, 1.0);
      shaft.tighten(part);
      of_tiles[i].push_back(shaft.region(part, light, frame));
    };
    if (!receivers.empty()) add(add, receivers);
  });
  std::vector<ReceiverRegion> out;
  for (const auto& regions : of_tiles) out.insert(out.end(), regions.begin(), regions.end());
  return out;
}

}  // namespace penumbra::detail
