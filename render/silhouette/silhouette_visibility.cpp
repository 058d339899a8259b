#include "render/silhouette/silhouette_visibility.h"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "penumbra/mesh/error.h"
#include "render/rays/reference.h"
#include "render/silhouette/collect/receiver_shells.h"
#include "render/silhouette/edge_hierarchies.h"
#include "render/silhouette/lit_groups.h"
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
        &SilhouetteCounts::row_sweeps, &SilhouetteCounts::overlapping, &SilhouetteCounts::unresolved,
        &SilhouetteCounts::rays, &SilhouetteCounts::second_rays})
    a.*member += b.*member;
  return a;
}

/// One call: what its shells of receivers share.
class Call {
 public:
  Call(const Scene& scene, const RayScene& rays, EdgeHierarchies& hierarchies, const CircularLight& light,
       const Receivers& receivers, const SilhouetteOptions& options, SilhouetteResult& out)
      : scene_(scene),
        rays_(rays),
        frame_(hierarchies.frame()),
        merged_(options.integrate && options.tolerance > 0.0 ? &hierarchies.merged(rays.arena()) : nullptr),
        edges_(hierarchies.edges(rays.arena())),
        boxes_(hierarchies.boxes(rays.arena())),
        groups_(hierarchies.groups(receivers, rays.arena())),
        groupings_(hierarchies.groupings()),
        light_(light),
        receivers_(receivers),
        options_(options),
        out_(out) {}

  void run(const Progress& progress);
  /// Receivers that rays have to see, ascending; stages and counts are complete but for them.
  std::vector<std::uint32_t> finish();

 private:
  void serve(const ReceiverShell& shell, const ShelledReceivers& all, const Progress& progress);
  template <class Make>
  auto in_arena(const Make& make) {
    return rays_.arena().execute(make);
  }

  const Scene& scene_;
  const RayScene& rays_;
  const RayFrame& frame_;
  const MergedEdges* merged_;
  const SceneEdges& edges_;
  const CasterBoxes& boxes_;
  const BoxedGroups& groups_;
  const std::size_t groupings_;
  const CircularLight& light_;
  const Receivers& receivers_;
  const SilhouetteOptions& options_;
  SilhouetteResult& out_;
  StageClock clock_;
  tbb::enumerable_thread_specific<Workspace> spaces_;
};

void Call::run(const Progress& progress) {
  const ShelledReceivers all =
      in_arena([&] { return ShelledReceivers(scene_, light_, receivers_, groups_); });
  out_.counts.casters_that_cannot_occlude =
      static_cast<std::size_t>(std::count(all.cannot_occlude.begin(), all.cannot_occlude.end(), char{1}));
  all.for_each(progress, [&](const ReceiverShell& shell, const Progress& part) { serve(shell, all, part); });
}

void Call::serve(const ReceiverShell& shell, const ShelledReceivers& all, const Progress& progress) {
  const UnitLight light(light_, shell.asked_about);
  const LitScene lit =
      in_arena([&] { return LitScene(scene_, light, edges_, shell.asked_about, all.cannot_occlude); });
  Passes passes =
      in_arena([&] { return make_passes(lit, edges_, merged_, options_.tolerance, receivers_.size()); });
  Tiles tiles(all.groups.count(), shell.groups, progress);
  const ReceiverSource source(receivers_, all.groups, light, options_.horizon,
                              {out_.visibility, out_.region});
  const LitGroups lit_groups(groups_, boxes_, lit, receivers_.has_normals() && options_.horizon);
  const auto band_of = [&](const std::vector<std::uint32_t>& some) {
    if (passes.now < passes.last()) return make_merged_band(lit, *merged_, *passes.levels[passes.now]);
    std::vector<ReceiverRegion> regions;
    if (passes.now > 0 && tiles.are_few(some, passes.band_size))
      regions = regions_of(some, passes, source, light, frame_);
    return make_band(lit, edges_, regions);
  };
  for (; passes.now <= passes.last(); ++passes.now) {
    const std::vector<std::uint32_t> some = tiles.waiting_for(passes.now);
    if (some.empty()) continue;
    Band band = in_arena([&] { return band_of(some); });
    clock_.finish("band");
    const auto evaluation = in_arena([&] {
      return std::make_unique<Evaluation>(scene_, rays_, receivers_, std::move(band), light, options_, source,
                                          passes, out_);
    });
    clock_.finish("band_tree");
    tiles.run(passes.now, some, rays_.arena(), spaces_, [&](std::size_t group, Workspace& w) {
      if (passes.now > 0 || !lit_groups.is_lit(group)) return evaluation->tile(group, w);
      evaluation->light_up(group, groups_.boxes[group].count, w);
      return 0u;
    });
    evaluation->add_counts(out_.counts);
    clock_.finish("receivers");
  }
}

std::vector<std::uint32_t> Call::finish() {
  std::vector<std::uint32_t> fallback;
  for (const Workspace& w : spaces_) {
    out_.counts += w.counts;
    out_.counts.bytes += w.bytes();
    fallback.insert(fallback.end(), w.fallback.begin(), w.fallback.end());
    out_.open.insert(out_.open.end(), w.open.begin(), w.open.end());
  }
  std::sort(out_.open.begin(), out_.open.end());
  out_.counts.groupings = groupings_;
  out_.counts.hierarchy_bytes = edges_.bytes() + (merged_ ? merged_->bytes() : 0);
  out_.stages = clock_.stages();
  return fallback;
}

void trace_fallback(const RayScene& rays, const LightShape& light, const Receivers& receivers,
                    const SilhouetteOptions& options, const std::vector<std::uint32_t>& indices,
                    SilhouetteResult& out) {
  StageClock clock;
  ReferenceOptions reference;
  reference.samples = options.fallback_samples;
  const ReferenceResult r = trace_reference(rays, light, receivers, indices, reference, !options.horizon);
  const std::vector<float>& values = options.horizon ? r.visibility : r.unoccluded;
  for (std::size_t i = 0; i < indices.size(); ++i) out.visibility[indices[i]] = values[i];
  out.counts.fallback = indices.size();
  out.counts.rays += r.rays;
  clock.finish("fallback");
  out.stages.push_back(clock.stages().front());
}

void require_valid(const CircularLight& light, const SilhouetteOptions& options) {
  if (!(light.radius > 0.0)) throw UsageError("silhouettes need a light of radius above 0");
  const std::vector<OptionSchema> schema = silhouette_options();
  require_allowed(schema, "silhouette-rows", static_cast<std::uint64_t>(options.rows));
  require_allowed(schema, "silhouette-tolerance", options.tolerance);
}

}  // namespace

SilhouetteResult silhouette_visibility(const Scene& scene, const RayScene& rays, EdgeHierarchies& hierarchies,
                                       const LightShape& shape, const Receivers& receivers,
                                       const SilhouetteOptions& options, const Progress& progress) {
  const CircularLight light = require_circular(shape, "silhouettes");
  require_valid(light, options);
  SilhouetteResult out;
  out.visibility.assign(receivers.size(), 1.0f);
  out.region.assign(receivers.size(), -1);
  Call call(scene, rays, hierarchies, light, receivers, options, out);
  call.run(progress);
  const std::vector<std::uint32_t> fallback = call.finish();
  if (!fallback.empty()) trace_fallback(rays, shape, receivers, options, fallback, out);
  return out;
}

}  // namespace penumbra
