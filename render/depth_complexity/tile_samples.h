// Method depth-complexity, from the band's edges to V: one tile of up to 64 receivers after the other.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/depth_complexity/depth_complexity.h"
#include "render/depth_complexity/sample_counters.h"
#include "render/silhouette/collect/tile_edges.h"

namespace penumbra::detail {

/// What a call is asked, and its light.
struct SampledCall {
  const RayScene& rays;
  const AreaLight& light;
  const Receivers& receivers;
  int samples;
  std::uint64_t seed;
  bool horizon;
};

/// A receiver's ray, and the samples that are visible if it meets nothing.
struct SampleTask {
  std::uint32_t index;
  std::size_t samples;
  Vec3 way;
};

/// What one thread keeps between tiles, and what it has counted.
struct TileWorkspace {
  TileWorkspace(const AreaLight& light, const UnitLight& unit, int samples)
      : counters(light, unit, samples) {}

  std::vector<TileReceiver> tile;
  TileEdgesMemory edges;
  TestedEdges tested;
  std::vector<Segment> segments;
  SampleCounters counters;
  std::vector<SampleTask> tasks;
  DepthComplexityCounts counts;
};

class TileSamples {
 public:
  /// Refers to its arguments.
  TileSamples(const SampledCall& call, const Band& band, const ReceiverSource& source,
              std::span<float> visibility);

  /// Writes V of the receivers of a group.
  void answer(std::size_t group, TileWorkspace& w) const;
  std::size_t bytes() const { return edges_.bytes(); }

 private:
  void find_segments(const TileReceiver& receiver, const EdgeList& list, TileWorkspace& w) const;
  void count(const TileReceiver& receiver, TileWorkspace& w) const;
  void settle(const SampleTask& task, const TileWorkspace& w) const;
  void trace(TileWorkspace& w) const;

  const SampledCall& call_;
  const TileEdges edges_;
  const ReceiverSource& source_;
  const Rounding rounding_;
  const std::span<float> visibility_;
};

}  // namespace penumbra::detail
