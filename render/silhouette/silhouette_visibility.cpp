#include "render/silhouette/silhouette_visibility.h"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "penumbra/mesh/error.h"
#include "render/rays/reference.h"
#include "render/receivers/occluding_casters.h"
#include "render/silhouette/edge_hierarchies.h"
#include "render/silhouette/silhouette_method.h"
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

void trace_fallback(const RayScene& rays, const DiskLight& light, const Receivers& receivers,
                    const SilhouetteOptions& options, const std::vector<std::uint32_t>& indices,
                    SilhouetteResult& out) {
  ReferenceOptions reference;
  reference.samples = options.fallback_samples;
  const ReferenceResult r = trace_reference(rays, light, receivers, indices, reference, !options.horizon);
  const std::vector<float>& values = options.horizon ? r.visibility : r.unoccluded;
  for (std::size_t i = 0; i < indices.size(); ++i) out.visibility[indices[i]] = values[i];
  out.counts.fallback = indices.size();
  out.counts.rays += r.rays;
}

void require_valid(const DiskLight& light, const SilhouetteOptions& options) {
  if (!(light.radius > 0.0)) throw UsageError("silhouettes need a light of radius above 0");
  const std::vector<OptionSchema> schema = silhouette_options();
  require_allowed(schema, "silhouette-rows", static_cast<std::uint64_t>(options.rows));
  require_allowed(schema, "silhouette-tolerance", options.tolerance);
}

/// Of receivers that need not lie on the scene; of pixels nothing.
Bounds bounds_beside_scene(const Receivers& receivers) {
  return receivers.are_pixels() ? Bounds() : bounds_of_present(receivers);
}

}  // namespace

SilhouetteResult silhouette_visibility(const Scene& scene, const RayScene& rays, EdgeHierarchies& hierarchies,
                                       const DiskLight& disk, const Receivers& receivers,
                                       const SilhouetteOptions& options, const Progress& progress) {
  require_valid(disk, options);
  SilhouetteResult out;
  out.visibility.assign(receivers.size(), 1.0f);
  out.region.assign(receivers.size(), -1);
  const bool may_merge = options.integrate && options.tolerance > 0.0;
  const MergedEdges* merged = may_merge ? &hierarchies.merged(rays.arena()) : nullptr;
  const SceneEdges& edges = hierarchies.edges(rays.arena());
  StageClock clock;
  const UnitLight light(disk);
  const ReceiverGroups groups = rays.arena().execute([&] { return ReceiverGroups(receivers); });
  const auto in_arena = [&](const auto& make) { return rays.arena().execute(make); };
  const std::vector<char> cannot_occlude =
      in_arena([&] { return find_casters_that_cannot_occlude(scene, disk, rays.frame(), receivers); });
  out.counts.casters_that_cannot_occlude =
      static_cast<std::size_t>(std::count(cannot_occlude.begin(), cannot_occlude.end(), char{1}));
  const LitScene lit =
      in_arena([&] { return LitScene(scene, light, edges, bounds_beside_scene(receivers), cannot_occlude); });

  Passes passes =
      in_arena([&] { return make_passes(lit, edges, merged, options.tolerance, receivers.size()); });
  Tiles tiles(groups, progress);
  const ReceiverSource source(receivers, groups, light, options.horizon, out);
  const auto band_of = [&](const std::vector<std::uint32_t>& some) {
    if (passes.now < passes.last()) return make_merged_band(lit, *merged, *passes.levels[passes.now]);
    std::vector<ReceiverRegion> regions;
    if (passes.now > 0 && tiles.are_few(some))
      regions = regions_of(some, passes, source, light, hierarchies.frame());
    return make_band(lit, edges, regions);
  };
  tbb::enumerable_thread_specific<Workspace> spaces;
  for (; passes.now <= passes.last(); ++passes.now) {
    const std::vector<std::uint32_t> some = tiles.waiting_for(passes.now);
    if (some.empty()) continue;
    Band band = in_arena([&] { return band_of(some); });
    clock.finish("band");
    const auto evaluation = in_arena([&] {
      return std::make_unique<Evaluation>(scene, rays, receivers, std::move(band), light, options, source,
                                          passes, out);
    });
    clock.finish("band_tree");
    tiles.run(passes.now, some, rays.arena(), spaces,
              [&](std::size_t group, Workspace& w) { return evaluation->tile(group, w); });
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
    trace_fallback(rays, disk, receivers, options, fallback, out);
    clock.finish("fallback");
  }
  out.stages = clock.stages();
  return out;
}

}  // namespace penumbra
