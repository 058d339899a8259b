#include "render/silhouette.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <atomic>
#include <glm/geometric.hpp>
#include <mutex>
#include <numbers>

#include "mesh/error.h"
#include "render/ray_scene_impl.h"
#include "render/reference.h"
#include "render/silhouette_fuse.h"
#include "render/silhouette_gather.h"
#include "render/silhouette_rays.h"

namespace penumbra {
namespace {

using namespace detail;

constexpr double kPi = std::numbers::pi;

/// What one thread keeps between tiles, and what it has counted.
struct Workspace {
  TileReceivers receivers;
  std::array<Chord, kTileReceivers> horizons;
  std::array<Fused, kTileReceivers> fused;
  std::array<double, kTileReceivers> disk_area;
  std::array<bool, kTileReceivers> certain;
  bool reached = false;  ///< some caster's box is in reach of the tile's shaft
  std::vector<std::uint32_t> edges;
  EdgeList list;
  Sight sight;
  Cut cut;
  Fuser fuser;
  std::vector<RayTask> tasks, second_tasks;
  std::vector<std::uint32_t> fallback, open;
  SilhouetteCounts counts;
};

/// One frame: everything that tiles share, and the result they write to (each its own pixels).
class Evaluation {
 public:
  Evaluation(const Scene& scene, const RayScene& rays, const SurfaceBuffer& surface, const Band& band,
             const BandTree& tree, const UnitLight& light, const SilhouetteOptions& options,
             SilhouetteResult& out)
      : scene_(scene),
        rays_(rays),
        surface_(surface),
        band_(band),
        tree_(tree),
        light_(light),
        options_(options),
        offset_(receiver_offset(rays.frame())),
        slack_(certificate_slack(band.extent)),
        out_(out) {}

  void tile(int column, int row, Workspace& w) const {
    collect(column, row, w);
    if (w.receivers.count == 0) return;
    ++w.counts.tiles;
    gather(w);
    if (!w.reached) return light_up(w);
    for (int i = 0; i < w.receivers.count; ++i) evaluate(i, w);
    decide(w);
  }

 private:
  void collect(int column, int row, Workspace& w) const;
  void add_receiver(std::size_t pixel, Workspace& w) const;
  void gather(Workspace& w) const;
  void evaluate(int i, Workspace& w) const;
  void integrate(int i, const DiskPart& part, Workspace& w) const;
  void decide(Workspace& w) const;
  void light_up(Workspace& w) const;

  const Scene& scene_;
  const RayScene& rays_;
  const SurfaceBuffer& surface_;
  const Band& band_;
  const BandTree& tree_;
  const UnitLight& light_;
  const SilhouetteOptions& options_;
  const double offset_, slack_;
  SilhouetteResult& out_;
};

void Evaluation::collect(int column, int row, Workspace& w) const {
  w.receivers.count = 0;
  w.receivers.horizon_cuts = false;
  const int x1 = std::min((column + 1) * kTile, surface_.width),
            y1 = std::min((row + 1) * kTile, surface_.height);
  for (int y = row * kTile; y < y1; ++y)
    for (int x = column * kTile; x < x1; ++x)
      add_receiver(static_cast<std::size_t>(y) * static_cast<std::size_t>(surface_.width) +
                       static_cast<std::size_t>(x),
                   w);
}

void Evaluation::add_receiver(std::size_t pixel, Workspace& w) const {
  if (!surface_.hit(pixel)) return;
  const Vec3& normal = surface_.normal[pixel];
  const Vec3 world = surface_.position[pixel] + offset_ * normal;
  const Vec3 x = light_.point(world);
  if (is_behind(scene_.light, surface_.position[pixel]) || !(x.z > 0.0)) {
    out_.visibility[pixel] = 0.0f;
    out_.region[pixel] = 2;
    ++w.counts.behind_light;
    return;
  }
  const Vec3 n = light_.direction(normal);
  // The center's height over the tangent plane, and how far the plane falls or rises across the disk.
  const double center = -glm::dot(n, x), fall2 = n.x * n.x + n.y * n.y;
  const bool cuts = center * center < fall2;
  if (!cuts && !(center > 0.0)) {
    out_.visibility[pixel] = 0.0f;
    return;
  }
  TileReceivers& r = w.receivers;
  const int i = r.count++;
  r.x[i] = x.x, r.y[i] = x.y, r.z[i] = x.z;
  r.normal[i] = n;
  r.pixel[i] = static_cast<std::uint32_t>(pixel);
  w.horizons[i] = cuts ? chord_of_plane(n, x, 1.0) : no_horizon();
  r.horizon_cuts = r.horizon_cuts || cuts;
}

void Evaluation::gather(Workspace& w) const {
  w.edges.clear();
  Shaft shaft(w.receivers, band_.extent);
  w.reached = !std::all_of(band_.casters.begin(), band_.casters.end(),
                           [&](const Bounds& box) { return shaft.misses(box.low, box.high); });
  if (w.reached && !tree_.misses(shaft)) {
    shaft.tighten(w.receivers);
    tree_.gather(shaft, w.edges);
  }
  w.list.assign(band_, w.edges, shaft.middle());
  w.tasks.clear();
  w.second_tasks.clear();
  w.counts.receivers += static_cast<std::size_t>(w.receivers.count);
  w.counts.listed_edges += w.edges.size();
  w.counts.empty_tiles += w.edges.empty() ? 1 : 0;
}

void Evaluation::integrate(int i, const DiskPart& part, Workspace& w) const {
  cut_segments(w.sight.segments, part, w.cut);
  if (!w.cut.closed) {
    w.fallback.push_back(w.receivers.pixel[i]);
    return;
  }
  w.fused[i] = w.fuser.fuse(w.cut, part, options_.rows);
  w.tasks.push_back({w.receivers.pixel[i], w.fused[i].aims[0], false, i});
  w.counts.segments += w.cut.segments.size();
  ++w.counts.integrated;
  w.counts.slabs += w.fused[i].way == Fusion::kSlabs ? 1 : 0;
  w.counts.fused += w.fused[i].way == Fusion::kRows ? 1 : 0;
  w.counts.overlapping += w.fused[i].levels > 2 ? 1 : 0;
}

void Evaluation::evaluate(int i, Workspace& w) const {
  const DiskPart part(w.horizons[i]);
  w.sight.segments.clear();
  w.sight.certain = true;
  if (w.list.size() > 0) {
    look(w.list, w.receivers.at(i), w.horizons[i], slack_, w.sight);
    w.counts.projected_edges += w.list.size();
  }
  // Below a horizon that cuts the disk edges may have been left out: nothing is certified there.
  w.certain[i] = w.sight.certain && !part.is_cut();
  if (w.sight.segments.empty()) {
    const glm::dvec2 middle = part.middle();
    w.fused[i] = {part.area(), 1, {middle, middle}};
    w.tasks.push_back({w.receivers.pixel[i], middle, false, i});
  } else if (options_.integrate) {
    integrate(i, part, w);
  } else {
    w.open.push_back(w.receivers.pixel[i]);
  }
}

/// No caster is between the tile and the light.
void Evaluation::light_up(Workspace& w) const {
  for (int i = 0; i < w.receivers.count; ++i) {
    const std::uint32_t pixel = w.receivers.pixel[i];
    out_.visibility[pixel] = static_cast<float>(half_plane_area(w.horizons[i].delta));
    out_.region[pixel] = 0;
  }
  w.counts.certified_lit += static_cast<std::size_t>(w.receivers.count);
}

/// The rays of a tile, and what they make of its areas.
void Evaluation::decide(Workspace& w) const {
  trace_tasks(rays_, surface_, light_, w.tasks);
  w.counts.rays += w.tasks.size();
  const auto settle = [&](const RayTask& task) {
    out_.visibility[task.pixel] = task.free ? static_cast<float>(w.fused[task.receiver].area / kPi) : 0.0f;
    if (!w.certain[task.receiver]) return;
    out_.region[task.pixel] = task.free ? 0 : 2;
    ++(task.free ? w.counts.certified_lit : w.counts.certified_umbra);
  };
  for (const RayTask& task : w.tasks) {
    const Fused& f = w.fused[task.receiver];
    if (task.free || f.aims[1] == f.aims[0])
      settle(task);
    else
      w.second_tasks.push_back({task.pixel, f.aims[1], false, task.receiver});
  }
  trace_tasks(rays_, surface_, light_, w.second_tasks);
  w.counts.second_rays += w.second_tasks.size();
  for (const RayTask& task : w.second_tasks) settle(task);
}

SilhouetteCounts& operator+=(SilhouetteCounts& a, const SilhouetteCounts& b) {
  for (const auto member :
       {&SilhouetteCounts::receivers, &SilhouetteCounts::certified_lit, &SilhouetteCounts::certified_umbra,
        &SilhouetteCounts::behind_light, &SilhouetteCounts::tiles, &SilhouetteCounts::empty_tiles,
        &SilhouetteCounts::listed_edges, &SilhouetteCounts::projected_edges, &SilhouetteCounts::segments,
        &SilhouetteCounts::integrated, &SilhouetteCounts::slabs, &SilhouetteCounts::fused,
        &SilhouetteCounts::overlapping, &SilhouetteCounts::rays, &SilhouetteCounts::second_rays})
    a.*member += b.*member;
  return a;
}

/// Runs `body(column, row, workspace)` for every tile, reporting progress.
template <class Spaces, class Body>
void for_each_tile(const RayScene& rays, const SurfaceBuffer& surface, Spaces& spaces,
                   const Progress& progress, const Body& body) {
  const int columns = (surface.width + kTile - 1) / kTile, rows = (surface.height + kTile - 1) / kTile;
  std::atomic<int> done{0};
  std::atomic<bool> stop{false};
  std::mutex reporting;
  rays.impl().arena.execute([&] {
    tbb::parallel_for(tbb::blocked_range<int>(0, columns * rows, 8),
                      [&](const tbb::blocked_range<int>& range) {
                        if (stop) return;
                        Workspace& w = spaces.local();
                        for (int i = range.begin(); i < range.end(); ++i) body(i % columns, i / columns, w);
                        const int finished = done += static_cast<int>(range.size());
                        if (progress && reporting.try_lock()) {
                          if (!progress(static_cast<double>(finished) / (columns * rows))) stop = true;
                          reporting.unlock();
                        }
                      });
  });
  if (stop) throw Cancelled();
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
}

}  // namespace

SilhouetteResult silhouette_visibility(const Scene& scene, const RayScene& rays, const SurfaceBuffer& surface,
                                       const SilhouetteOptions& options, const Progress& progress) {
  require_valid(scene, options);
  SilhouetteResult out;
  out.visibility.assign(surface.size(), 1.0f);
  out.region.assign(surface.size(), -1);
  StageClock clock;
  const UnitLight light(scene.light);
  Band band;
  rays.impl().arena.execute([&] { band = make_band(scene, light); });
  clock.finish("band");
  const BandTree tree(band);
  clock.finish("band_tree");

  tbb::enumerable_thread_specific<Workspace> spaces;
  const Evaluation evaluation(scene, rays, surface, band, tree, light, options, out);
  for_each_tile(rays, surface, spaces, progress,
                [&](int column, int row, Workspace& w) { evaluation.tile(column, row, w); });
  std::vector<std::uint32_t> fallback;
  for (const Workspace& w : spaces) {
    out.counts += w.counts;
    fallback.insert(fallback.end(), w.fallback.begin(), w.fallback.end());
    out.open.insert(out.open.end(), w.open.begin(), w.open.end());
  }
  std::sort(out.open.begin(), out.open.end());
  clock.finish("receivers");
  if (!fallback.empty()) {
    trace_fallback(scene, rays, surface, options, fallback, out);
    clock.finish("fallback");
  }
  out.counts.faces = band.faces;
  out.counts.mixed_faces = band.mixed_faces;
  out.counts.mesh_edges = band.mesh_edges;
  out.counts.band_edges = band.edges.size();
  out.counts.cut_edges = band.cut_edges;
  out.counts.bytes = tree.bytes();
  out.stages = clock.stages();
  return out;
}

}  // namespace penumbra
