#include "render/soft_shadow_volumes/soft_shadow_volumes.h"

#include <tbb/enumerable_thread_specific.h>

#include <memory>

#include "render/light/circle_around.h"
#include "render/rays/each_receiver.h"
#include "render/silhouette/collect/receiver_shells.h"
#include "render/silhouette/edges/scene_edges.h"
#include "render/soft_shadow_volumes/wedges.h"

namespace penumbra {
namespace {

using namespace detail;

SoftShadowVolumeCounts& operator+=(SoftShadowVolumeCounts& a, const SoftShadowVolumeCounts& b) {
  for (const auto member : {&SoftShadowVolumeCounts::listed_edges, &SoftShadowVolumeCounts::wedges,
                            &SoftShadowVolumeCounts::rays, &SoftShadowVolumeCounts::counted})
    a.*member += b.*member;
  return a;
}

/// One call: what its shells of receivers share.
class Call {
 public:
  Call(const Scene& scene, const SceneEdges& edges, const WedgeCall& call, const LightShape& shape,
       const SoftShadowVolumeOptions& options, SoftShadowVolumeResult& out)
      : scene_(scene),
        edges_(edges),
        call_(call),
        disk_(circle_around(shape)),
        options_(options),
        out_(out) {}

  void run(const Progress& progress);

 private:
  void serve(const ReceiverShell& shell, const ShelledReceivers& all, const Progress& progress);
  template <class Make>
  auto in_arena(const Make& make) {
    return call_.rays.arena().execute(make);
  }

  const Scene& scene_;
  const SceneEdges& edges_;
  const WedgeCall& call_;
  const CircularLight disk_;
  const SoftShadowVolumeOptions& options_;
  SoftShadowVolumeResult& out_;
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
  // The light's patches, each with its silhouette.
  const UnitLight unit(disk_, shell.asked_about);
  const LightPatches patches(call_.light, unit, options_.splits);
  std::vector<std::unique_ptr<Wedges>> wedges;
  in_arena([&] {
    const LayeredBand band =
        make_layered_band(scene_, unit, edges_, shell.asked_about, all.cannot_occlude, call_.layers);
    for (const LightPatch& patch : patches.patches)
      wedges.push_back(std::make_unique<Wedges>(call_, unit, patches, patch, band));
    out_.counts.faces = band.band.faces;
    out_.counts.mesh_edges = band.band.mesh_edges;
    out_.counts.band_edges += band.band.edges.size();
  });
  for (const auto& each : wedges) out_.counts.silhouette_edges += each->silhouette_edges();
  out_.counts.patches = patches.patches.size();
  clock_.finish("silhouettes");

  // What receivers see of them.
  const ReceiverSource source(call_.receivers, all.groups, unit, options_.horizon, {out_.visibility});
  tbb::enumerable_thread_specific<WedgeMemory> spaces;
  for_each_block(call_.rays.arena(), shell.groups.size(), progress, [&](std::size_t i) {
    WedgeMemory& memory = spaces.local();
    source.collect(shell.groups[i], memory.tile);
    for (const TileReceiver& receiver : memory.tile) out_.visibility[receiver.index] = 0.0f;
    for (const auto& each : wedges) each->add(memory.tile, memory, out_.visibility);
  });
  for (const WedgeMemory& memory : spaces) out_.counts += memory.counts;
  clock_.finish("receivers");
}

}  // namespace

SoftShadowVolumeResult soft_shadow_volumes(const Scene& scene, const RayScene& rays, const SceneEdges& edges,
                                           const LightShape& shape, const Receivers& receivers,
                                           const SoftShadowVolumeOptions& options, const Progress& progress) {
  SoftShadowVolumeResult out;
  out.visibility.assign(receivers.size(), 1.0f);
  const AreaLight light = area_light(shape);
  const std::vector<double> layers = layers_of_faces(scene, rays, circle_around(shape));
  const WedgeCall call{.rays = rays, .light = light, .receivers = receivers, .layers = layers};
  SoftShadowVolumeOptions checked = options;
  checked.horizon = options.horizon && receivers.has_normals();
  Call(scene, edges, call, shape, checked, out).run(progress);
  return out;
}

}  // namespace penumbra
