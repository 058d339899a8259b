#include "render/view_samples/view_samples.h"

#include <tbb/enumerable_thread_specific.h>

#include <optional>

#include "render/light/circle_around.h"
#include "render/rays/each_receiver.h"
#include "render/silhouette/collect/receiver_shells.h"
#include "render/view_samples/masked_tiles.h"

namespace penumbra {

using namespace detail;

ViewSampleResult view_sample_visibility(const Scene& scene, const LightShape& shape,
                                        const Receivers& receivers, const ViewSampleOptions& options,
                                        tbb::task_arena& threads, const Progress& progress) {
  ViewSampleResult out;
  out.visibility.assign(receivers.size(), 1.0f);
  StageClock clock;
  const AreaLight light = area_light(shape);
  const CircularLight disk = circle_around(shape);
  MaskCall call{scene, light, receivers, options};
  call.options.horizon = options.horizon && receivers.has_normals();
  const BoxedGroups groups = threads.execute([&] { return BoxedGroups(receivers); });
  const ShelledReceivers all =
      threads.execute([&] { return ShelledReceivers(scene, disk, receivers, groups); });
  all.for_each(progress, [&](const ReceiverShell& shell, const Progress& part) {
    const UnitLight unit(disk, shell.asked_about);
    std::optional<FaceTree> faces;
    threads.execute([&] { faces.emplace(scene, unit, all.cannot_occlude); });
    out.counts.faces = faces->size();
    clock.finish("faces");
    const ReceiverSource source(receivers, all.groups, unit, call.options.horizon, {out.visibility});
    const MaskedTiles tiles(call, *faces, source, out.visibility);
    tbb::enumerable_thread_specific<MaskWorkspace> spaces(
        [&] { return MaskWorkspace(light, unit, options.samples); });
    for_each_block(threads, shell.groups.size(), part,
                   [&](std::size_t i) { tiles.answer(shell.groups[i], spaces.local()); });
    for (const MaskWorkspace& w : spaces)
      for (const auto member : {&ViewSampleCounts::receivers, &ViewSampleCounts::listed_faces,
                                &ViewSampleCounts::masks, &ViewSampleCounts::covers})
        out.counts.*member += w.counts.*member;
    clock.finish("receivers");
  });
  out.stages = clock.stages();
  return out;
}

}  // namespace penumbra
