#include "render/silhouette/tile_evaluation.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>

namespace penumbra::detail {
namespace {

constexpr double kPi = std::numbers::pi;

constexpr std::size_t kShortList = 24;   // edges; shorter lists are not narrowed
constexpr std::size_t kManyBlocks = 64;  // lists of more may be narrowed down to receivers block by block,
constexpr double kMostKept = 0.4;        // if one receiver keeps at most that share
constexpr double kMostMistaken = 2.0;    // of the disk, over how far silhouettes may be moved
constexpr double kSliver = 0.5;          // the same, at most, of what is no depth complexity of its own
constexpr std::array<std::size_t, 3> kPartSizes{64, 16, 4};  // receivers that share a list of blocks

/// In place, member by member: a task made elsewhere and copied is read in wider pieces than it was written
/// in, for which the processor waits; with what else was copied so, a twentieth of a simple scene's time.
void add_task(std::vector<RayTask>& tasks, std::uint32_t index, const glm::dvec2& aim, std::size_t receiver) {
  RayTask& task = tasks.emplace_back();
  task.index = index;
  task.aim.x = aim.x;
  task.aim.y = aim.y;
  task.receiver = receiver;
}

}  // namespace

std::uint32_t Evaluation::tile(std::size_t group, Workspace& w) const {
  const std::size_t behind = source_.collect(group, w.tile);
  if (passes_.now > 0) {
    std::erase_if(w.tile, [&](const TileReceiver& r) { return passes_.of[r.index] != passes_.now; });
  } else {
    w.counts.receivers += w.tile.size();
    w.counts.behind_light += behind;
  }
  w.later = 0;
  if (!w.tile.empty()) part(w.tile, w);
  return w.later;
}

/// Receivers that lie close together.
void Evaluation::part(std::span<TileReceiver> receivers, Workspace& w) const {
  Shaft shaft(receivers, band_.extent);
  w.blocks[0].clear();
  const bool reached = is_reached(shaft);
  if (reached && !tree_.misses(shaft)) {
    if (band_.edges.size() > kShortList) shaft.tighten(receivers);  // costs more than few edges
    tree_.collect(shaft, w.blocks[0]);
    const double most = kMostMistaken * options_.tolerance;
    const Mistaken m = mistaken(shaft, w.blocks[0]);
    const double share = m.area / kPi;
    if (!(share <= most))
      return leave(receivers, passes_.next(passes_.deviation[passes_.now] * most / share), w);
    w.sliver = std::min(share, kSliver * options_.tolerance);
    w.beside = m.beside;
  }
  ++w.counts.tiles;
  w.counts.merged_receivers += band_.is_merged() ? receivers.size() : 0;
  w.receivers.assign(receivers.begin(), receivers.end());
  if (reached) {
    look_around(shaft, w);
  } else {
    ++w.counts.empty_tiles;
    light_up(w);
  }
}

/// To a later pass. Where no merged edges will do, halves are tried: a tile may show two surfaces, one of
/// which is near to what casts.
void Evaluation::leave(std::span<TileReceiver> receivers, int pass, Workspace& w) const {
  if (pass == passes_.last() && receivers.size() > kFewReceivers) {
    const std::size_t middle = halve(receivers);
    part(receivers.first(middle), w);
    return part(receivers.subspan(middle), w);
  }
  for (const TileReceiver& r : receivers) passes_.of[r.index] = static_cast<std::uint8_t>(pass);
  w.later |= 1u << pass;
}

/// What the receivers of a shaft may have mistaken of the merged edges in a list of blocks.
Mistaken Evaluation::mistaken(const Shaft& shaft, const std::vector<NodeMask>& list) const {
  Mistaken out;
  if (!band_.is_merged()) return out;
  const FloatShaft in_float(shaft, band_.extent);
  for_each_block(list, [&](std::size_t block) {
    if (!band_.lanes[block].is_exact) add_mistaken(band_.lanes[block], in_float, out);
  });
  return out;
}

void Evaluation::look_around(const Shaft& shaft, Workspace& w) const {
  if (band_.is_merged()) w.uncertain.begin_tile(band_, w.blocks[0], shaft);
  w.areas.resize(w.receivers.size());
  w.certain.resize(w.receivers.size());
  w.right.resize(w.receivers.size());
  w.tasks.clear();
  if (is_too_long(count_blocks(w.blocks[0]) * BandTree::kFanOut, w.receivers.size())) {
    open(0, w.receivers.size(), w);
  } else if (are_blocks_better(w)) {
    w.counts.listed_edges += count_blocks(w.blocks[0]) * BandTree::kFanOut;
    divide_blocks(0, w.receivers.size(), 0, w);
  } else {
    blocks_.collect(w.blocks[0], shaft, w.edges);
    w.counts.listed_edges += w.edges.size();
    w.counts.empty_tiles += w.edges.empty() ? 1 : 0;
    w.list.assign(band_, w.edges, shaft.middle());
    divide(0, w.receivers.size(), w);
  }
  decide(w);
}

/// A long list stays in blocks where one receiver drops most of them; on rough surfaces it drops few, and a
/// list of single edges is shorter.
bool Evaluation::are_blocks_better(Workspace& w) const {
  const std::size_t blocks = count_blocks(w.blocks[0]);
  if (blocks <= kManyBlocks) return false;
  tree_.narrow(w.blocks[0], std::span(w.receivers).subspan(w.receivers.size() / 2, 1), w.blocks[1]);
  return static_cast<double>(count_blocks(w.blocks[1])) <= kMostKept * static_cast<double>(blocks);
}

/// The box of some caster is between the shaft's receivers and the light.
bool Evaluation::is_reached(const Shaft& shaft) const {
  return std::any_of(band_.casters.begin(), band_.casters.end(),
                     [&](const Bounds& box) { return !shaft.misses(box.low, box.high); });
}

/// To narrow a list down for so many receivers takes as long as for each of them to look at most_listed
/// edges.
bool Evaluation::is_too_long(std::size_t edges, std::size_t receivers) const {
  return options_.most_listed > 0 && edges > options_.most_listed * receivers;
}

void Evaluation::open(std::size_t first, std::size_t last, Workspace& w) const {
  for (std::size_t i = first; i < last; ++i) w.open.push_back(w.receivers[i].index);
}

/// Receivers first to last, one by one: with the tile's list where it is short, else in parts that lie apart,
/// each with what is left of the list.
void Evaluation::divide(std::size_t first, std::size_t last, Workspace& w) const {
  if (w.list.size() <= kShortList) return evaluate(first, last, w.list, w);
  const auto part = std::span(w.receivers).subspan(first, last - first);
  if (part.size() > kFewReceivers) {
    const std::size_t middle = first + halve(part);
    divide(first, middle, w);
    return divide(middle, last, w);
  }
  if (is_too_long(w.list.size(), part.size())) return open(first, last, w);
  Shaft shaft(part, band_.extent);
  shaft.tighten(part);
  narrow(w.list, shaft, w.edges);
  w.part_list.assign(w.list, w.edges);
  evaluate(first, last, w.part_list, w);
}

/// The same with lists of blocks: halved until parts are small enough to narrow the list for, three times
/// over.
void Evaluation::divide_blocks(std::size_t first, std::size_t last, std::size_t level, Workspace& w) const {
  const std::vector<NodeMask>& list = w.blocks[level];
  if (level + 1 == kPartSizes.size()) {
    for (std::size_t i = first; i < last; ++i) evaluate_blocks(i, list, w);
    return;
  }
  const auto part = std::span(w.receivers).subspan(first, last - first);
  if (part.size() > kPartSizes[level + 1]) {
    const std::size_t middle = first + halve(part);
    divide_blocks(first, middle, level, w);
    return divide_blocks(middle, last, level, w);
  }
  if (level == 0) w.uncertain.begin_part(part);
  tree_.narrow(list, part, w.blocks[level + 1]);
  divide_blocks(first, last, level + 1, w);
}

void Evaluation::integrate(std::size_t i, const DiskPart& part, Workspace& w) const {
  clip_segments(w.projected.segments, w.projected.inside, part, w.clipped);
  if (!w.clipped.closed) {
    w.fallback.push_back(w.receivers[i].index);
    return;
  }
  w.visible_area.compute(w.clipped, part, options_.rows, w.sliver, w.areas[i]);
  if (!aim_surely(i, w.clipped.segments, part, w)) return;
  add_task(w.tasks, w.receivers[i].index, w.areas[i].aims[0], i);
  w.counts.segments += w.clipped.segments.size();
  ++w.counts.integrated;
  w.counts.slabs += w.areas[i].method == AreaMethod::kSlabs ? 1 : 0;
  w.counts.row_sweeps += w.areas[i].method == AreaMethod::kRows ? 1 : 0;
  w.counts.overlapping += w.areas[i].complexities > 2 ? 1 : 0;
  w.counts.unresolved += w.areas[i].resolved ? 0 : 1;
}

void Evaluation::evaluate(std::size_t first, std::size_t last, const EdgeList& list, Workspace& w) const {
  for (std::size_t begin = first; begin < last; begin += kFewReceivers) {
    const std::size_t end = std::min(begin + kFewReceivers, last);
    w.uncertain.begin_part(std::span(w.receivers).subspan(begin, end - begin));
    for (std::size_t i = begin; i < end; ++i) evaluate(i, list, w);
  }
}

void Evaluation::evaluate(std::size_t i, const EdgeList& list, Workspace& w) const {
  const TileReceiver& r = w.receivers[i];
  if (is_too_long(list.size(), 1)) return w.open.push_back(r.index);
  project_edges(list, r.x, r.horizon, rounding_, w.projected);
  w.counts.projected_edges += list.size();
  judge(i, w);
}

void Evaluation::evaluate_blocks(std::size_t i, const std::vector<NodeMask>& list, Workspace& w) const {
  const TileReceiver& r = w.receivers[i];
  const std::size_t most =
      options_.most_listed > 0 ? options_.most_listed / BandTree::kFanOut : blocks_.count();
  if (!blocks_.test_edges(tree_, list, r, most, w.projected.tested)) return w.open.push_back(r.index);
  project_edges(band_, w.projected.tested, r.x, r.horizon, rounding_, w.projected);
  w.counts.projected_edges += BandTree::kFanOut * w.projected.tested.looked_into;
  judge(i, w);
}

/// Nothing is across the disk for certain. Below a horizon that cuts the disk edges may have been left out:
/// nothing is certified there. Of merged faces some may look the other way than their patch does.
bool Evaluation::is_certain(std::size_t i, const DiskPart& part, Workspace& w) const {
  if (!w.projected.certain || part.is_cut()) return false;
  return !band_.is_merged() || w.uncertain.are_none(w.receivers[i], DiskSpot{}, rounding_.slack);
}

/// Merged edges tell the right number of faces before a point.
bool Evaluation::is_right_at(const glm::dvec2& point, std::size_t i, Workspace& w) const {
  return w.uncertain.are_none(w.receivers[i], DiskSpot::point(point), rounding_.slack);
}

/// Where merged edges are looked at, aims at a point at which one ray tells where the lowest depth complexity
/// is 0. That is a point at which merged edges are right. Where a point lies far from all silhouettes they
/// are, if the ray meets no face: then there is none on the wrong side. Returns false where neither point
/// will do; the receiver then waits.
bool Evaluation::aim_surely(std::size_t i, std::span<const Segment> segments, const DiskPart& part,
                            Workspace& w) const {
  if (!band_.is_merged() || w.certain[i]) return true;
  auto& aims = w.areas[i].aims;
  for (const glm::dvec2& aim : {aims[0], aims[1]}) {
    w.right[i] = !has_room(aim, w.beside, segments, part);
    if (w.right[i] && !is_right_at(aim, i, w)) continue;
    aims = {aim, aim};
    return true;
  }
  wait(i, w);
  return false;
}

/// For the last pass.
void Evaluation::wait(std::size_t i, Workspace& w) const {
  passes_.of[w.receivers[i].index] = static_cast<std::uint8_t>(passes_.last());
  w.later |= 1u << passes_.last();
}

/// What a receiver sees, integrated; or the certificate.
void Evaluation::judge(std::size_t i, Workspace& w) const {
  const TileReceiver& r = w.receivers[i];
  const DiskPart part(r.horizon);
  w.certain[i] = is_certain(i, part, w);
  if (w.projected.segments.empty()) {
    const glm::dvec2 middle = part.middle();
    VisibleAreaResult& result = w.areas[i];
    result.area = part.area();
    result.complexities = 1;
    result.aims[0] = result.aims[1] = middle;
    result.method = AreaMethod::kChain;
    result.resolved = true;
    if (!aim_surely(i, {}, part, w)) return;
    add_task(w.tasks, r.index, middle, i);
  } else if (options_.integrate &&
             (options_.most_segments == 0 || w.projected.segments.size() <= options_.most_segments)) {
    integrate(i, part, w);
  } else {
    w.open.push_back(w.receivers[i].index);
  }
}

/// No caster is between the tile and the light.
void Evaluation::light_up(Workspace& w) const {
  for (const TileReceiver& r : w.receivers) {
    out_.visibility[r.index] = static_cast<float>(half_plane_area(r.horizon.delta));
    out_.region[r.index] = 0;
  }
  w.counts.certified_lit += w.receivers.size();
}

void Evaluation::light_up(std::size_t group, std::size_t count, Workspace& w) const {
  source_.light_up(group);
  ++w.counts.tiles;
  ++w.counts.empty_tiles;
  w.counts.receivers += count;
  w.counts.merged_receivers += band_.is_merged() ? count : 0;
  w.counts.certified_lit += count;
}

/// Where nothing crosses the disk the answer holds for all of it. It is certified if it is beyond doubt, and
/// left to a plain ray if not.
void Evaluation::certify(const RayTask& task, Workspace& w) const {
  if (!task.free && !is_hidden(scene_, rays_, receivers_, light_, band_.depth, task.index)) {
    add_task(w.second_tasks, task.index, task.aim, task.receiver);
    return;
  }
  out_.visibility[task.index] = task.free ? 1.0f : 0.0f;
  out_.region[task.index] = task.free ? 0 : 2;
  ++(task.free ? w.counts.certified_lit : w.counts.certified_umbra);
}

/// The rays of a tile, and what they make of its areas.
void Evaluation::decide(Workspace& w) const {
  const auto settle = [&](const RayTask& task) {
    out_.visibility[task.index] = task.free ? static_cast<float>(w.areas[task.receiver].area / kPi) : 0.0f;
  };
  w.second_tasks.clear();
  w.uncertain.begin_part({});
  trace_tasks(rays_, receivers_, light_, band_.depth, w.tasks);
  for (const RayTask& task : w.tasks) {
    const VisibleAreaResult& f = w.areas[task.receiver];
    if (w.certain[task.receiver])
      certify(task, w);
    else if (!task.free && band_.is_merged() && !w.right[task.receiver] &&
             !is_right_at(task.aim, task.receiver, w))
      wait(task.receiver, w);
    else if (task.free || f.aims[1] == f.aims[0])
      settle(task);
    else
      add_task(w.second_tasks, task.index, f.aims[1], task.receiver);
  }
  trace_tasks(rays_, receivers_, light_, band_.depth, w.second_tasks);
  for (const RayTask& task : w.second_tasks) settle(task);
  w.counts.rays += w.tasks.size();
  w.counts.second_rays += w.second_tasks.size();
}

}  // namespace penumbra::detail
