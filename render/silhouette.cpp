#include "render/silhouette.h"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <array>
#include <bit>
#include <glm/geometric.hpp>
#include <memory>
#include <numbers>
#include <utility>

#include "mesh/error.h"
#include "render/idle_casters.h"
#include "render/ray_scene_impl.h"
#include "render/reference.h"
#include "render/silhouette_blocks.h"
#include "render/silhouette_fuse.h"
#include "render/silhouette_gather.h"
#include "render/silhouette_passes.h"
#include "render/silhouette_rays.h"
#include "render/silhouette_receivers.h"

namespace penumbra {
namespace {

using namespace detail;

constexpr double kPi = std::numbers::pi;

constexpr std::size_t kShortList = 24;        // edges; shorter lists are not narrowed
constexpr std::size_t kMostToCertify = 8192;  // edges; with more, rays cost less than to look for what is
                                              // hardly ever found there
constexpr std::size_t kManyBlocks = 64;  // lists of more may be narrowed down to receivers block by block,
constexpr double kMostKept = 0.4;        // if one receiver keeps at most that share
constexpr double kSliver = 0.5;          // of the disk, for how far silhouettes are moved
constexpr std::array<std::size_t, 3> kPartSizes{64, 16, 4};  // receivers that share a list of blocks

/// What one thread keeps between tiles, and what it has counted.
struct Workspace {
  std::vector<Receiver> tile;       ///< all of a tile
  std::vector<Receiver> receivers;  ///< of it, those at hand
  std::vector<Fused> fused;         ///< one a receiver
  std::vector<char> certain;        ///< one a receiver
  std::vector<std::uint32_t> edges;
  std::vector<EdgesOfBlock> doubtful;           ///< merged edges, see gather_doubtful; when first asked for,
  const Shaft* doubts_at = nullptr;             ///< for these receivers
  std::array<std::vector<Siblings>, 3> blocks;  ///< of the tile, and of its parts
  EdgeList list, part_list;                     ///< of the tile, and of the part at hand
  Sight sight;
  Cut cut;
  Fuser fuser;
  std::vector<RayTask> tasks, second_tasks;
  std::vector<std::uint32_t> undecided;  ///< pixels of the tile
  double sliver = 0.0;                   ///< of the receivers at hand, see Fuser::fuse
  std::uint32_t later = 0;               ///< passes that some of the tile's receivers are left to, as bits
  std::vector<std::uint32_t> fallback, open;
  SilhouetteCounts counts;

  std::size_t bytes() const {
    std::size_t sum =
        receivers.capacity() * (sizeof(Receiver) + sizeof(Fused)) + edges.capacity() * sizeof(edges[0]);
    for (const auto& b : blocks) sum += b.capacity() * sizeof(b[0]);
    return sum + list.bytes() + part_list.bytes();
  }
};

/// In place, member by member: a task made elsewhere and copied is read in wider pieces than it was written
/// in, for which the processor waits; with what else was copied so, a twentieth of a simple scene's time.
void add_task(std::vector<RayTask>& tasks, std::uint32_t pixel, const glm::dvec2& aim, bool step_back,
              std::size_t receiver) {
  RayTask& task = tasks.emplace_back();
  task.pixel = pixel;
  task.aim.x = aim.x;
  task.aim.y = aim.y;
  task.step_back = step_back;
  task.receiver = receiver;
}

/// One frame: everything that tiles share, and the result they write to (each its own pixels).
class Evaluation {
 public:
  Evaluation(const Scene& scene, const RayScene& rays, const SurfaceBuffer& surface, Band band,
             const UnitLight& light, const SilhouetteOptions& options, Passes& passes, SilhouetteResult& out)
      : scene_(scene),
        rays_(rays),
        surface_(surface),
        band_(std::move(band)),
        tree_(band_),
        blocks_(band_),
        light_(light),
        options_(options),
        source_(scene, rays.frame(), surface, light, out),
        slack_(certificate_slack(band_.extent)),
        passes_(passes),
        out_(out) {}

  /// Looks at the tile's receivers whose turn it is. Returns the passes that those are left to for which the
  /// band's edges are moved too far, as bits.
  std::uint32_t tile(int column, int row, Workspace& w) const;
  /// What is known of the band.
  void add_counts(SilhouetteCounts& out) const {
    out.faces = band_.faces;
    out.mesh_edges = band_.mesh_edges;
    out.band_edges += band_.edges.size();
    out.cut_edges = band_.cut_edges;
    out.bytes += band_.edges.size() * sizeof(BandEdge) + tree_.bytes() + blocks_.bytes();
  }

 private:
  void part(std::span<Receiver> receivers, Workspace& w) const;
  void leave(std::span<Receiver> receivers, int pass, Workspace& w) const;
  bool is_reached(const Shaft& shaft) const;
  /// In the light's plane and light radii: how far silhouettes of merged faces in a list of blocks are moved
  /// at most for any of the receivers. In light radii: how far they might be moved (`MergedEdge::moved`).
  struct Moves {
    double most = 0.0, allowed = std::numeric_limits<double>::infinity();
  };
  Moves moves(const Shaft& shaft, const std::vector<Siblings>& list) const;
  void look_around(const Shaft& shaft, Workspace& w) const;
  bool is_beyond_doubt(std::size_t i, const DiskPart& part, Workspace& w) const;
  bool are_blocks_better(Workspace& w) const;
  void divide(std::size_t first, std::size_t last, Workspace& w) const;
  void divide_blocks(std::size_t first, std::size_t last, std::size_t level, Workspace& w) const;
  void evaluate(std::size_t i, const EdgeList& list, Workspace& w) const;
  void evaluate_blocks(std::size_t i, const std::vector<Siblings>& list, Workspace& w) const;
  void judge(std::size_t i, Workspace& w) const;
  void integrate(std::size_t i, const DiskPart& part, Workspace& w) const;
  void certify(const RayTask& task, Workspace& w) const;
  void decide(Workspace& w) const;
  void light_up(Workspace& w) const;

  const Scene& scene_;
  const RayScene& rays_;
  const SurfaceBuffer& surface_;
  const Band band_;
  const BandTree tree_;
  const EdgeBlocks blocks_;
  const UnitLight& light_;
  const SilhouetteOptions& options_;
  const ReceiverSource source_;
  const double slack_;
  Passes& passes_;
  SilhouetteResult& out_;
};

std::uint32_t Evaluation::tile(int column, int row, Workspace& w) const {
  w.undecided.clear();
  const std::size_t behind = source_.collect(column, row, w.tile, w.undecided);
  if (passes_.now > 0) {
    std::erase_if(w.tile, [&](const Receiver& r) { return passes_.of[r.pixel] != passes_.now; });
  } else {
    w.counts.receivers += w.tile.size();
    w.counts.behind_light += behind;
    auto& unknown = options_.integrate ? w.fallback : w.open;
    unknown.insert(unknown.end(), w.undecided.begin(), w.undecided.end());
  }
  w.later = 0;
  if (!w.tile.empty()) part(w.tile, w);
  return w.later;
}

/// Receivers that lie close together.
void Evaluation::part(std::span<Receiver> receivers, Workspace& w) const {
  Shaft shaft(receivers, band_.extent);
  w.blocks[0].clear();
  const bool reached = is_reached(shaft);
  if (reached && !tree_.misses(shaft)) {
    if (band_.edges.size() > kShortList) shaft.tighten(receivers);  // costs more than few edges
    tree_.gather(shaft, w.blocks[0]);
    const Moves m = moves(shaft, w.blocks[0]);
    if (m.most > options_.moved) return leave(receivers, passes_.next(m.allowed), w);
    w.sliver = kSliver * m.most;
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
void Evaluation::leave(std::span<Receiver> receivers, int pass, Workspace& w) const {
  if (pass == passes_.last() && receivers.size() > kFewReceivers) {
    const std::size_t middle = halve(receivers);
    part(receivers.first(middle), w);
    return part(receivers.subspan(middle), w);
  }
  for (const Receiver& r : receivers) passes_.of[r.pixel] = static_cast<std::uint8_t>(pass);
  w.later |= 1u << pass;
}

/// What lies at p is seen by x magnified by x.z/(x.z - p.z) and, at a slant, by |x - p|/(x.z - p.z) once
/// more; p in a block's box, x in that of the receivers.
Evaluation::Moves Evaluation::moves(const Shaft& shaft, const std::vector<Siblings>& list) const {
  const Vec3 middle = shaft.middle();
  const double lowest = middle.z - shaft.half().z, highest = middle.z + shaft.half().z;
  Moves out;
  for_each_block(list, [&](std::size_t block) {
    if (block >= band_.moved.size() || !(band_.moved[block] > 0.0f)) return;
    const BlockBounds& b = band_.bounds[block];
    const double below = std::max(0.0, lowest - b.high.z);
    const double away =
        glm::distance(middle, 0.5 * (b.low + b.high)) + glm::length(shaft.half() + 0.5 * (b.high - b.low));
    const double magnified = away * highest / (below * below);
    out.most = std::max(out.most, band_.moved[block] * magnified);
    out.allowed = std::min(out.allowed, options_.moved / magnified);
  });
  return out;
}

void Evaluation::look_around(const Shaft& shaft, Workspace& w) const {
  w.doubts_at = &shaft;
  w.fused.resize(w.receivers.size());
  w.certain.resize(w.receivers.size());
  w.tasks.clear();
  if (are_blocks_better(w)) {
    w.counts.listed_edges += count_blocks(w.blocks[0]) * BandTree::kFanOut;
    divide_blocks(0, w.receivers.size(), 0, w);
  } else {
    blocks_.gather(w.blocks[0], shaft, w.edges);
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

/// Receivers first to last, one by one: with the tile's list where it is short, else in parts that lie apart,
/// each with what is left of the list.
void Evaluation::divide(std::size_t first, std::size_t last, Workspace& w) const {
  if (w.list.size() <= kShortList) {
    for (std::size_t i = first; i < last; ++i) evaluate(i, w.list, w);
    return;
  }
  const auto part = std::span(w.receivers).subspan(first, last - first);
  if (part.size() > kFewReceivers) {
    const std::size_t middle = first + halve(part);
    divide(first, middle, w);
    return divide(middle, last, w);
  }
  Shaft shaft(part, band_.extent);
  shaft.tighten(part);
  narrow(w.list, shaft, w.edges);
  w.part_list.assign(w.list, w.edges);
  for (std::size_t i = first; i < last; ++i) evaluate(i, w.part_list, w);
}

/// The same with lists of blocks: halved until parts are small enough to narrow the list for, three times
/// over.
void Evaluation::divide_blocks(std::size_t first, std::size_t last, std::size_t level, Workspace& w) const {
  const std::vector<Siblings>& list = w.blocks[level];
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
  tree_.narrow(list, part, w.blocks[level + 1]);
  divide_blocks(first, last, level + 1, w);
}

void Evaluation::integrate(std::size_t i, const DiskPart& part, Workspace& w) const {
  cut_segments(w.sight.segments, w.sight.inside, part, w.cut);
  if (!w.cut.closed) {
    w.fallback.push_back(w.receivers[i].pixel);
    return;
  }
  w.fuser.fuse(w.cut, part, options_.rows, w.sliver, w.fused[i]);
  add_task(w.tasks, w.receivers[i].pixel, w.fused[i].aims[0], false, i);
  w.counts.segments += w.cut.segments.size();
  ++w.counts.integrated;
  w.counts.slabs += w.fused[i].way == Fusion::kSlabs ? 1 : 0;
  w.counts.fused += w.fused[i].way == Fusion::kRows ? 1 : 0;
  w.counts.overlapping += w.fused[i].levels > 2 ? 1 : 0;
}

void Evaluation::evaluate(std::size_t i, const EdgeList& list, Workspace& w) const {
  const Receiver& r = w.receivers[i];
  if (!options_.integrate && list.size() > kMostToCertify) return w.open.push_back(r.pixel);
  look(list, r.x, r.horizon, slack_, w.sight);
  w.counts.projected_edges += list.size();
  judge(i, w);
}

void Evaluation::evaluate_blocks(std::size_t i, const std::vector<Siblings>& list, Workspace& w) const {
  const Receiver& r = w.receivers[i];
  const std::size_t most = options_.integrate ? blocks_.count() : kMostToCertify / BandTree::kFanOut;
  if (!blocks_.sift(tree_, list, r, most, w.sight.sifted)) return w.open.push_back(r.pixel);
  look(band_, w.sight.sifted, r.x, r.horizon, slack_, w.sight);
  w.counts.projected_edges += BandTree::kFanOut * w.sight.sifted.looked_into;
  judge(i, w);
}

/// Nothing is across the disk for certain. Below a horizon that cuts the disk edges may have been left out:
/// nothing is certified there. Of merged faces some may look the other way than their patch does.
bool Evaluation::is_beyond_doubt(std::size_t i, const DiskPart& part, Workspace& w) const {
  if (!w.sight.certain || part.is_cut()) return false;
  if (!band_.is_merged()) return true;
  if (w.doubts_at) gather_doubtful(band_, w.blocks[0], *std::exchange(w.doubts_at, nullptr), w.doubtful);
  if (w.doubtful.empty()) return true;
  const Receiver& r = w.receivers[i];
  auto doubtful = w.doubtful.begin();
  for (const std::int32_t block : blocks_.blocks_for(tree_, w.blocks[0], r, w.sight.sifted)) {
    while (doubtful != w.doubtful.end() && doubtful->block < block) ++doubtful;
    if (doubtful == w.doubtful.end()) return true;
    if (doubtful->block != block) continue;
    for (std::uint32_t edges = doubtful->edges; edges != 0; edges &= edges - 1) {
      const std::size_t edge = static_cast<std::size_t>(block) * BandTree::kFanOut +
                               static_cast<std::size_t>(std::countr_zero(edges));
      if (!is_certainly_none(band_, edge, r, slack_)) return false;
    }
  }
  return true;
}

/// What a receiver sees, integrated; or the certificate.
void Evaluation::judge(std::size_t i, Workspace& w) const {
  const Receiver& r = w.receivers[i];
  const DiskPart part(r.horizon);
  w.certain[i] = is_beyond_doubt(i, part, w);
  if (w.sight.segments.empty()) {
    const glm::dvec2 middle = part.middle();
    Fused& fused = w.fused[i];
    fused.area = part.area();
    fused.levels = 1;
    fused.aims[0] = fused.aims[1] = middle;
    fused.way = Fusion::kChain;
    add_task(w.tasks, r.pixel, middle, w.certain[i] != 0, i);
  } else if (options_.integrate) {
    integrate(i, part, w);
  } else {
    w.open.push_back(w.receivers[i].pixel);
  }
}

/// No caster is between the tile and the light.
void Evaluation::light_up(Workspace& w) const {
  for (const Receiver& r : w.receivers) {
    out_.visibility[r.pixel] = static_cast<float>(half_plane_area(r.horizon.delta));
    out_.region[r.pixel] = 0;
  }
  w.counts.certified_lit += w.receivers.size();
}

/// Where nothing crosses the disk the answer holds for all of it. It is certified if it is beyond doubt, and
/// left to a plain ray if not.
void Evaluation::certify(const RayTask& task, Workspace& w) const {
  if (!task.free && !is_hidden(scene_, rays_, surface_, task.pixel)) {
    add_task(w.second_tasks, task.pixel, task.aim, false, task.receiver);
    return;
  }
  out_.visibility[task.pixel] = task.free ? 1.0f : 0.0f;
  out_.region[task.pixel] = task.free ? 0 : 2;
  ++(task.free ? w.counts.certified_lit : w.counts.certified_umbra);
}

/// The rays of a tile, and what they make of its areas.
void Evaluation::decide(Workspace& w) const {
  const auto settle = [&](const RayTask& task) {
    out_.visibility[task.pixel] = task.free ? static_cast<float>(w.fused[task.receiver].area / kPi) : 0.0f;
  };
  w.second_tasks.clear();
  trace_tasks(rays_, surface_, light_, w.tasks);
  for (const RayTask& task : w.tasks) {
    const Fused& f = w.fused[task.receiver];
    if (w.certain[task.receiver])
      certify(task, w);
    else if (task.free || f.aims[1] == f.aims[0])
      settle(task);
    else
      add_task(w.second_tasks, task.pixel, f.aims[1], false, task.receiver);
  }
  trace_tasks(rays_, surface_, light_, w.second_tasks);
  for (const RayTask& task : w.second_tasks) settle(task);
  w.counts.rays += w.tasks.size();
  w.counts.second_rays += w.second_tasks.size();
}

SilhouetteCounts& operator+=(SilhouetteCounts& a, const SilhouetteCounts& b) {
  for (const auto member :
       {&SilhouetteCounts::receivers, &SilhouetteCounts::merged_receivers, &SilhouetteCounts::certified_lit,
        &SilhouetteCounts::certified_umbra, &SilhouetteCounts::behind_light, &SilhouetteCounts::tiles,
        &SilhouetteCounts::empty_tiles, &SilhouetteCounts::listed_edges, &SilhouetteCounts::projected_edges,
        &SilhouetteCounts::segments, &SilhouetteCounts::integrated, &SilhouetteCounts::slabs,
        &SilhouetteCounts::fused, &SilhouetteCounts::overlapping, &SilhouetteCounts::rays,
        &SilhouetteCounts::second_rays})
    a.*member += b.*member;
  return a;
}

void trace_fallback(const Scene& scene, const RayScene& rays, const SurfaceBuffer& surface,
                    const SilhouetteOptions& options, const std::vector<std::uint32_t>& pixels,
                    SilhouetteResult& out) {
  ReferenceOptions reference;
  reference.samples = options.fallback_samples;
  const ReferenceResult r = trace_reference(scene, rays, surface, pixels, reference);
  for (std::size_t i = 0; i < pixels.size(); ++i) out.visibility[pixels[i]] = r.visibility[i];
  out.counts.fallback = pixels.size();
  out.counts.rays += r.rays;
}

void require_valid(const Scene& scene, const SilhouetteOptions& options) {
  if (!(scene.light.radius > 0.0)) throw UsageError("silhouettes need a light of radius above 0");
  if (options.rows < 4 || options.rows > 1024)
    throw UsageError("rows must lie in 4 to 1024, not " + std::to_string(options.rows));
  if (!(options.moved >= 0.0 && options.moved <= 0.1))
    throw UsageError("moved must lie in 0 to 0.1 light radii, not " + std::to_string(options.moved));
}

}  // namespace

SilhouetteResult silhouette_visibility(const Scene& scene, const RayScene& rays, const SurfaceBuffer& surface,
                                       const SilhouetteOptions& options, const Progress& progress) {
  require_valid(scene, options);
  SilhouetteResult out;
  out.visibility.assign(surface.size(), 1.0f);
  out.region.assign(surface.size(), -1);
  const bool may_merge = options.integrate && options.moved > 0.0;
  const MergedEdges* merged = may_merge ? &rays.impl().merged_edges() : nullptr;
  const SceneEdges& edges = rays.impl().edges();
  StageClock clock;
  const UnitLight light(scene.light);
  const auto in_arena = [&](const auto& make) { return rays.impl().arena.execute(make); };
  const std::vector<char> idle = in_arena([&] { return find_idle_casters(scene, rays.frame(), surface); });
  out.counts.idle_casters = static_cast<std::size_t>(std::count(idle.begin(), idle.end(), char{1}));
  const LitScene lit = in_arena([&] { return LitScene(scene, light, rays.frame().scale, idle); });

  Passes passes = in_arena([&] { return make_passes(lit, edges, merged, options.moved, surface.size()); });
  Tiles tiles(surface, progress);
  const auto band_of = [&](const std::vector<int>& some) {
    if (passes.now < passes.last()) return make_merged_band(lit, *merged, *passes.levels[passes.now]);
    std::vector<Region> regions;
    if (passes.now > 0 && tiles.are_few(some))
      regions = regions_of(tiles, some, passes, ReceiverSource(scene, rays.frame(), surface, light, out),
                           light, rays.frame());
    return make_band(lit, edges, regions);
  };
  tbb::enumerable_thread_specific<Workspace> spaces;
  for (; passes.now <= passes.last(); ++passes.now) {
    const std::vector<int> some = tiles.waiting_for(passes.now);
    if (some.empty()) continue;
    Band band = in_arena([&] { return band_of(some); });
    clock.finish("band");
    const auto evaluation = in_arena([&] {
      return std::make_unique<Evaluation>(scene, rays, surface, std::move(band), light, options, passes, out);
    });
    clock.finish("band_tree");
    tiles.run(passes.now, some, rays, spaces,
              [&](int column, int row, Workspace& w) { return evaluation->tile(column, row, w); });
    evaluation->add_counts(out.counts);
    clock.finish("receivers");
  }
  out.counts.hierarchy_bytes = edges.bytes() + (merged ? merged->bytes() : 0);
  std::vector<std::uint32_t> fallback;
  for (const Workspace& w : spaces) {
    out.counts += w.counts;
    out.counts.bytes += w.bytes();
    fallback.insert(fallback.end(), w.fallback.begin(), w.fallback.end());
    out.open.insert(out.open.end(), w.open.begin(), w.open.end());
  }
  std::sort(out.open.begin(), out.open.end());
  if (!fallback.empty()) {
    trace_fallback(scene, rays, surface, options, fallback, out);
    clock.finish("fallback");
  }
  out.stages = clock.stages();
  return out;
}

}  // namespace penumbra
