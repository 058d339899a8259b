#include "render/silhouette/silhouette_visibility.h"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "penumbra/mesh/error.h"
#include "render/rays/ray_scene_impl.h"
#include "render/rays/reference.h"
#include "render/receivers/occluding_casters.h"
#include "render/silhouette/tile_evaluation.h"

namespace penumbra {
namespace {

using namespace detail;

SilhouetteCounts& operator+=(SilhouetteCounts& a, const SilhouetteCounts& b) {
  for (const auto member :
       {&SilhouetteCounts::receivers, &SilhouetteCounts::merged_receivers, &SilhouetteCounts::certified_lit,
        &SilhouetteCounts::certified_umbra, &SilhouetteCounts::behind_light, &SilhouetteCounts::tiles,
        &SilhouetteCounts::empty_tiles, &SilhouetteCounts::listed_edges, &SilhouetteCounts::projected_edges,
        &SilhouetteCounts::segments, &SilhouetteCounts::integrated, &SilhouetteCounts::slabs,
        &SilhouetteCounts::row_sweeps, &SilhouetteCounts::overlapping, &SilhouetteCounts::rays,
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
  if (!(options.tolerance >= 0.0 && options.tolerance <= 0.1))
    throw UsageError("tolerance must lie in 0 to 0.1 light radii, not " + std::to_string(options.tolerance));
}

}  // namespace

SilhouetteResult silhouette_visibility(const Scene& scene, const RayScene& rays, const SurfaceBuffer& surface,
                                       const SilhouetteOptions& options, const Progress& progress) {
  require_valid(scene, options);
  SilhouetteResult out;
  out.visibility.assign(surface.size(), 1.0f);
  out.region.assign(surface.size(), -1);
  const bool may_merge = options.integrate && options.tolerance > 0.0;
  const MergedEdges* merged = may_merge ? &rays.impl().merged_edges() : nullptr;
  const SceneEdges& edges = rays.impl().edges();
  StageClock clock;
  const UnitLight light(scene.light);
  const auto in_arena = [&](const auto& make) { return rays.impl().arena.execute(make); };
  const std::vector<char> cannot_occlude =
      in_arena([&] { return find_casters_that_cannot_occlude(scene, rays.frame(), surface); });
  out.counts.casters_that_cannot_occlude =
      static_cast<std::size_t>(std::count(cannot_occlude.begin(), cannot_occlude.end(), char{1}));
  const LitScene lit = in_arena([&] { return LitScene(scene, light, edges, cannot_occlude); });

  Passes passes =
      in_arena([&] { return make_passes(lit, edges, merged, options.tolerance, surface.size()); });
  Tiles tiles(surface, progress);
  const auto band_of = [&](const std::vector<int>& some) {
    if (passes.now < passes.last()) return make_merged_band(lit, *merged, *passes.levels[passes.now]);
    std::vector<ReceiverRegion> regions;
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
