#include "render/soft_shadow_volumes/wedges.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <utility>

namespace penumbra::detail {

Wedges::Wedges(const WedgeCall& call, const UnitLight& unit, const LightPatches& patches,
               const LightPatch& patch, const LayeredBand& band)
    : call_(call),
      unit_(unit),
      patches_(patches),
      patch_(patch),
      silhouette_(band, patch.center),
      edges_(silhouette_.band),
      rounding_{certificate_slack(band.band.extent), band.band.extent} {}

/// The patch above the receiver's horizon, and a point of it: its center, or where that is below the horizon
/// another one.
CenterTask Wedges::begin(const TileReceiver& receiver, WedgeMemory& memory) const {
  const Chord& horizon = receiver.horizon;
  CenterTask task{receiver.index, patch_.center, 0.0, 0.0, false};
  if (!receiver.horizon_cuts) {
    memory.outline = patch_.outline;
  } else {
    clip(patch_.outline, horizon, memory.outline);
    if (!(glm::dot(horizon.normal, patch_.center) + horizon.delta > 0.0)) {
      clip(patch_.inner, horizon, memory.inner);
      if (patches_.whole_disk)
        task.aim = horizon.normal * (0.5 * (1.0 - horizon.delta));
      else if (memory.inner.size() > 2 && area_of(memory.inner) > 0.0)
        task.aim = centroid_of(memory.inner);
    }
  }
  task.area = memory.outline.size() > 2 ? patches_.area(memory.outline) : 0.0;
  return task;
}

/// The area of the patch above the horizon behind the segment a b, as seen from the task's aim: positive
/// where that lies on the left of a → b, else negative.
double Wedges::area_behind_edge(const glm::dvec2& a, const glm::dvec2& b, const CenterTask& task, bool cut,
                                WedgeMemory& memory) const {
  if (patches_.whole_disk && !cut && task.aim == glm::dvec2(0.0)) return area_behind(a, b);
  const double turn = cross(a - task.aim, b - task.aim);
  if (turn == 0.0) return 0.0;
  const glm::dvec2 &first = turn > 0.0 ? a : b, &last = turn > 0.0 ? b : a;
  clip(memory.outline, left_of(task.aim, first), memory.behind);
  clip(memory.behind, left_of(last, task.aim), memory.other);
  clip(memory.other, left_of(last, first), memory.behind);
  if (memory.behind.size() < 3) return 0.0;
  const double area = patches_.area(memory.behind);
  return turn > 0.0 ? area : -area;
}

/// Where an edge runs through the aim, no ray tells on which side it is: the aim moves to the point of a few
/// beside it that is farthest from all edges.
void Wedges::aim_beside_edges(const TileReceiver& receiver, CenterTask& task, WedgeMemory& memory) const {
  constexpr double kTooNear = 1e-5, kAside = 0.1;  // radii of the light; share of the way to a corner
  constexpr std::size_t kCandidates = 4;
  const auto room = [&](const glm::dvec2& p) {
    double least = 2.0;
    for (const WedgeEdge& edge : memory.wedges) least = std::min(least, distance_to(p, edge.a, edge.b));
    return least;
  };
  double most = room(task.aim);
  if (most > kTooNear) return;
  memory.inner = patch_.inner;
  if (receiver.horizon_cuts) clip(patch_.inner, receiver.horizon, memory.inner);
  const glm::dvec2 from = task.aim;
  const std::size_t step = std::max<std::size_t>(1, memory.inner.size() / kCandidates);
  for (std::size_t i = 0; i < memory.inner.size(); i += step) {
    const glm::dvec2 aside = from + kAside * (memory.inner[i] - from);
    if (const double free = room(aside); free > most) most = free, task.aim = aside;
  }
}

void Wedges::add_wedges(const TileReceiver& receiver, const EdgeList& list, CenterTask& task,
                        WedgeMemory& memory) const {
  memory.counts.listed_edges += list.size();
  memory.wedges.clear();
  for_each_near(list, receiver.x, memory.tested, [&](const BandEdge& edge) {
    const Projection p = project_segment(edge.a, edge.b, receiver.x, rounding_);
    if (p.near) memory.wedges.push_back({p.segment.a, p.segment.b, silhouette_.step_of(edge)});
  });
  memory.counts.wedges += memory.wedges.size();
  aim_beside_edges(receiver, task, memory);
  for (const WedgeEdge& edge : memory.wedges) {
    const double area = area_behind_edge(edge.a, edge.b, task, receiver.horizon_cuts, memory);
    // Behind an edge whose left side the aim is on, its right side begins.
    task.hidden -= edge.step * area;
    task.in_wedge = task.in_wedge || area != 0.0;
  }
}

void Wedges::add(std::span<TileReceiver> tile, WedgeMemory& memory, std::span<float> visibility) const {
  memory.tasks.clear();
  const bool is_reached =
      edges_.for_each(tile, memory.edges, [&](const TileReceiver& receiver, const EdgeList& list) {
        CenterTask task = begin(receiver, memory);
        if (!(task.area > 0.0)) return;
        add_wedges(receiver, list, task, memory);
        memory.tasks.push_back(task);
      });
  if (is_reached) return trace(memory, visibility);
  for (const TileReceiver& receiver : tile) settle(begin(receiver, memory), 0.0, visibility);
}

Ray Wedges::ray_of(const CenterTask& task) const {
  const Vec3 way =
      call_.light.from_receiver(call_.receivers.points[task.index]) + unit_.offset_on_disk(task.aim);
  return {start_of(call_.receivers, task.index), way, call_.light.distant};
}

/// `layers`: those that hide the aim.
void Wedges::settle(const CenterTask& task, double layers, std::span<float> visibility) const {
  const double seen = std::clamp((1.0 - layers) * task.area - task.hidden, 0.0, std::max(0.0, task.area));
  visibility[task.index] += static_cast<float>(seen / patches_.total);
}

void Wedges::trace(WedgeMemory& memory, std::span<float> visibility) const {
  constexpr std::size_t kRays = RayPacket::kRays;
  const std::vector<CenterTask>& tasks = memory.tasks;
  RayPacket packet;
  packet.endless = call_.light.distant;
  for (std::size_t first = 0; first < tasks.size(); first += kRays) {
    const std::size_t count = std::min(kRays, tasks.size() - first);
    for (std::size_t k = 0; k < kRays; ++k) {
      packet.wanted[k] = k < count ? -1 : 0;
      packet.set(k, ray_of(tasks[first + std::min(k, count - 1)]));
    }
    find_occluded(call_.rays, packet, Coherence::kCoherent);
    for (std::size_t k = 0; k < count; ++k) {
      const CenterTask& task = tasks[first + k];
      double layers = 0.0;
      if (packet.is_occluded(k)) {
        layers = 1.0;
        if (task.in_wedge) {
          // More do not matter: the wedges cannot take them away.
          layers = layers_passed(ray_of(task), call_.rays, call_.layers, 1.0 - task.hidden / task.area);
          ++memory.counts.counted;
        }
      }
      settle(task, layers, visibility);
    }
  }
  memory.counts.rays += tasks.size();
}

}  // namespace penumbra::detail
