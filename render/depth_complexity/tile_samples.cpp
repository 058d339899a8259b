#include "render/depth_complexity/tile_samples.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "render/rays/ray_packets.h"
#include "render/receivers/sample_key.h"

namespace penumbra::detail {
namespace {

/// Half way from the horizon to the rim above it; the middle of a disk that no horizon cuts.
glm::dvec2 start_on(const Chord& horizon) {
  return horizon.delta < 1.0 ? horizon.normal * (0.5 * (1.0 - horizon.delta)) : glm::dvec2(0.0);
}

bool is_above(const Chord& horizon, const glm::dvec2& p) {
  return glm::dot(horizon.normal, p) + horizon.delta > 0.0;
}

}  // namespace

TileSamples::TileSamples(const SampledCall& call, const Band& band, const ReceiverSource& source,
                         std::span<float> visibility)
    : call_(call),
      edges_(band),
      source_(source),
      rounding_{certificate_slack(band.extent), band.extent},
      visibility_(visibility) {}

void TileSamples::answer(std::size_t group, TileWorkspace& w) const {
  source_.collect(group, w.tile);
  if (w.tile.empty()) return;
  ++w.counts.tiles;
  w.counts.receivers += w.tile.size();
  w.tasks.clear();
  const bool is_reached =
      edges_.for_each(w.tile, w.edges, [&](const TileReceiver& receiver, const EdgeList& list) {
        find_segments(receiver, list, w);
        count(receiver, w);
      });
  if (is_reached) return trace(w);
  w.segments.clear();
  for (const TileReceiver& receiver : w.tile) count(receiver, w);
  for (const SampleTask& task : w.tasks) settle(task, w);
}

/// The silhouettes across the disk that are not wholly below the horizon.
void TileSamples::find_segments(const TileReceiver& receiver, const EdgeList& list, TileWorkspace& w) const {
  w.segments.clear();
  w.counts.listed_edges += list.size();
  for_each_near(list, receiver.x, w.tested, [&](const BandEdge& edge) {
    const Projection p = project_edge(edge, receiver.x, rounding_);
    if (p.near && (is_above(receiver.horizon, p.segment.a) || is_above(receiver.horizon, p.segment.b)))
      w.segments.push_back(p.segment);
  });
}

/// Adds the receiver's task, unless none of its samples is above the horizon.
void TileSamples::count(const TileReceiver& receiver, TileWorkspace& w) const {
  const std::uint32_t i = receiver.index;
  const Vec3 to_center = call_.light.from_receiver(call_.receivers.points[i]);
  visibility_[i] = 0.0f;
  if (w.segments.empty() && !receiver.horizon_cuts) {
    // All samples are visible, or none is.
    w.tasks.push_back({i, static_cast<std::size_t>(w.counters.count()), to_center});
    return;
  }
  w.counters.begin({.to_center = to_center,
                    .normal = call_.horizon ? call_.receivers.normals[i] : Vec3(0.0),
                    .key = sample_key_of(call_.receivers, i, call_.seed),
                    .start = start_on(receiver.horizon)});
  for (const Segment& segment : w.segments) w.counts.toggled_samples += w.counters.toggle(segment);
  w.counts.segments += w.segments.size();
  const SampleCounters::Lowest lowest = w.counters.lowest(w.segments);
  if (lowest.samples > 0) w.tasks.push_back({i, lowest.samples, w.counters.way(lowest.aim)});
}

/// The ray met nothing.
void TileSamples::settle(const SampleTask& task, const TileWorkspace& w) const {
  visibility_[task.index] =
      static_cast<float>(task.samples) * (1.0f / static_cast<float>(w.counters.count()));
}

void TileSamples::trace(TileWorkspace& w) const {
  constexpr std::size_t kRays = RayPacket::kRays;
  RayPacket packet;
  packet.endless = call_.light.distant;
  for (std::size_t first = 0; first < w.tasks.size(); first += kRays) {
    const std::size_t count = std::min(kRays, w.tasks.size() - first);
    for (std::size_t k = 0; k < kRays; ++k) {
      const SampleTask& task = w.tasks[first + std::min(k, count - 1)];
      packet.wanted[k] = k < count ? -1 : 0;
      packet.set(k, {start_of(call_.receivers, task.index), task.way, packet.endless});
    }
    find_occluded(call_.rays, packet, Coherence::kCoherent);
    for (std::size_t k = 0; k < count; ++k)
      if (!packet.is_occluded(k)) settle(w.tasks[first + k], w);
  }
  w.counts.rays += w.tasks.size();
}

}  // namespace penumbra::detail
