#include "render/depth_complexity/depth_complexity.h"

#include <tbb/enumerable_thread_specific.h>

#include <memory>

#include "render/depth_complexity/tile_samples.h"
#include "render/light/circle_around.h"
#include "render/rays/each_receiver.h"
#include "render/silhouette/collect/receiver_shells.h"
#include "render/silhouette/edges/scene_edges.h"

namespace penumbra {
namespace {

using namespace detail;

DepthComplexityCounts& operator+=(DepthComplexityCounts& a, const DepthComplexityCounts& b) {
  for (const auto member : {&DepthComplexityCounts::receivers, &DepthComplexityCounts::tiles,
                            &DepthComplexityCounts::listed_edges, &DepthComplexityCounts::segments,
                            &DepthComplexityCounts::toggled_samples, &DepthComplexityCounts::rays})
    a.*member += b.*member;
  return a;
}

/// One call: what its shells of receivers share.
class Call {
 public:
  Call(const Scene& scene, const SampledCall& call, const SceneEdges& edges, const LightShape& shape,
       DepthComplexityResult& out)
      : scene_(scene), call_(call), edges_(edges), disk_(circle_around(shape)), out_(out) {}

  void run(const Progress& progress);

 private:
  void serve(const ReceiverShell& shell, const ShelledReceivers& all, const Progress& progress);
  template <class Make>
  auto in_arena(const Make& make) {
    return call_.rays.arena().execute(make);
  }

  const Scene& scene_;
  const SampledCall& call_;
  const SceneEdges& edges_;
  const CircularLight disk_;
  DepthComplexityResult& out_;
  StageClock clock_;
};

void Call::run(const Progress& progress) {
  const BoxedGroups groups = in_arena([&] { return BoxedGroups(call_.receivers); });
  const ShelledReceivers all =
      in_arena([&] { return ShelledReceivers(scene_, disk_, call_.receivers, groups); });
  all.for_each(progress, [&](const ReceiverShell& shell, const Progress& part) { serve(shell, all, part); });
  out_.stages = clock_.stages();
}

void Call::serve(const ReceiverShell& shell, const ShelledReceivers& all, const Progress& progress) {
  const UnitLight unit(disk_, shell.asked_about);
  const Band band = in_arena([&] {
    return make_band(LitScene(scene_, unit, edges_, shell.asked_about, all.cannot_occlude), edges_);
  });
  clock_.finish("band");
  const ReceiverSource source(call_.receivers, all.groups, unit, call_.horizon, {out_.visibility});
  const auto tiles =
      in_arena([&] { return std::make_unique<TileSamples>(call_, band, source, out_.visibility); });
  clock_.finish("band_tree");
  tbb::enumerable_thread_specific<TileWorkspace> spaces(
      [&] { return TileWorkspace(call_.light, unit, call_.samples); });
  for_each_block(call_.rays.arena(), shell.groups.size(), progress,
                 [&](std::size_t i) { tiles->answer(shell.groups[i], spaces.local()); });
  for (const TileWorkspace& w : spaces) out_.counts += w.counts;
  out_.counts.faces = band.faces;
  out_.counts.mesh_edges = band.mesh_edges;
  out_.counts.band_edges += band.edges.size();
  out_.counts.bytes += band.bytes() + tiles->bytes();
  clock_.finish("receivers");
}

}  // namespace

DepthComplexityResult depth_complexity_visibility(const Scene& scene, const RayScene& rays,
                                                  const SceneEdges& edges, const LightShape& shape,
                                                  const Receivers& receivers,
                                                  const DepthComplexityOptions& options,
                                                  const Progress& progress) {
  DepthComplexityResult out;
  out.visibility.assign(receivers.size(), 1.0f);
  const AreaLight light = area_light(shape);
  const SampledCall call{.rays = rays,
                         .light = light,
                         .receivers = receivers,
                         .samples = options.samples,
                         .seed = options.seed,
                         .horizon = options.horizon && receivers.has_normals()};
  Call(scene, call, edges, shape, out).run(progress);
  return out;
}

}  // namespace penumbra
