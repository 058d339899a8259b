// The method soft-shadow-volumes: hard shadows, corrected in the penumbra wedges of the silhouettes that the
// light's center sees.
//
// In: casters, a light, receivers, into how many patches the light is split. Out: V of each receiver.
//
//   1. silhouettes  the edges that are silhouettes as seen from a patch's center (center_silhouette.h)
//   2. constant     the layers that hide the patch's center from the receiver, by rays (layers.h)
//   3. wedges       each silhouette edge, projected from the receiver onto the light, adds or takes away the
//                   area behind it as seen from the center (polygon_area.h, wedges.h)
//
// What a receiver does not see is the sum of what its layers hide, at most all of a patch; the patches add
// up.
//
// U. Assarsson, T. Akenine-Möller, "A geometry-based soft shadow volume algorithm using graphics hardware"
// (2003); U. Assarsson, M. Dougherty, M. Mounier, T. Akenine-Möller, "An optimized soft shadow volume
// algorithm with real-time performance" (2003), for the split; "Casting Shadows in Real Time" (2009),
// sections 5.3.2.2 and 5.3.2.3. They look areas up in a table of four dimensions, and draw a wedge as a
// volume to find its receivers. Here the area is exact, and receivers find their edges. The horizon is one
// more border of the light: where it hides the center, another point above it takes its place.
#pragma once

#include <cstdint>
#include <vector>

#include "penumbra/mesh/progress.h"
#include "penumbra/mesh/stage_clock.h"
#include "penumbra/render/receivers/receivers.h"
#include "penumbra/render/scene/scene.h"
#include "render/rays/ray_scene.h"

namespace penumbra {

namespace detail {
class SceneEdges;
}

struct SoftShadowVolumeOptions {
  /// Patches along each side of the light, 1 to 8.
  int splits = 1;
  /// false: nothing lies below a horizon; V is then O.
  bool horizon = true;
};

/// What was done for one light. Sums are over receivers unless said otherwise.
struct SoftShadowVolumeCounts {
  /// Of the casters.
  std::size_t faces = 0, mesh_edges = 0, band_edges = 0;
  /// Sum over patches.
  std::size_t silhouette_edges = 0;
  std::size_t patches = 0;
  /// Edges that receivers looked at, and of these those across the light: their wedges hold the receiver.
  std::size_t listed_edges = 0, wedges = 0;
  /// One a receiver and patch, and those whose layers were counted.
  std::size_t rays = 0, counted = 0;
};

struct SoftShadowVolumeResult {
  /// One a receiver; 1 where there is none.
  std::vector<float> visibility;
  StageTimes stages;
  SoftShadowVolumeCounts counts;
};

/// `edges`: of the scene, in the frame of rays. Requires a light that is no point. Cost for each patch: the
/// band, the silhouette edges near each tile, and for each receiver its wedges and a ray, or a ray a face
/// where the center is hidden in a penumbra. On all threads of `rays`; the result does not depend on their
/// number. Throws Cancelled.
SoftShadowVolumeResult soft_shadow_volumes(const Scene& scene, const RayScene& rays,
                                           const detail::SceneEdges& edges, const LightShape& light,
                                           const Receivers& receivers,
                                           const SoftShadowVolumeOptions& options = {},
                                           const Progress& progress = {});

}  // namespace penumbra
