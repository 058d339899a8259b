// The method shadow-volumes: hard shadows, by the number of shadow volumes around each receiver.
//
// In: casters, a light, receivers. Out: V of each receiver, 1 or 0: whether it sees the light's center. That
// is what the method `hard` finds by rays.
//
//   1. culling   casters that hide the center from no receiver are left out
//   2. polygons  caps and sides of the volumes of all others (center_view/volume_polygons.h)
//   3. count     those around each receiver (volume_counter.h)
//
// F. Crow, "Shadow algorithms for computer graphics" (1977); T. Heidmann, "Real shadows real time" (1991); C.
// Everitt, M. Kilgard, "Practical and robust stenciled shadow volumes" (2002); B. Lloyd and others, "CC
// shadow volumes" (2004); "Casting Shadows in Real Time" (2009), section 2.2. They count in a stencil buffer,
// along rays from the camera. Here lines of one direction, which depends on the light alone, take the place
// of those: no clip plane, no eye inside of a volume, and receivers need not be pixels.
#pragma once

#include <vector>

#include "penumbra/mesh/progress.h"
#include "penumbra/mesh/stage_clock.h"
#include "penumbra/render/receivers/receivers.h"
#include "penumbra/render/scene/scene.h"
#include "render/rays/ray_scene.h"

namespace penumbra {

struct ShadowVolumeOptions {
  /// Leave out casters whose volumes hold no receiver.
  bool cull = true;
  /// End sides below the deepest receiver.
  bool clamp = true;
  /// false: nothing lies below a horizon; V is then O.
  bool horizon = true;
};

struct ShadowVolumeCounts {
  /// With volumes, and those left out.
  std::size_t casters = 0, culled_casters = 0;
  /// Of all volumes, and those that receivers may meet.
  std::size_t caps = 0, sides = 0, reached_caps = 0, reached_sides = 0;
  /// Sums over receivers: polygons looked at, and those that the line to infinity meets.
  std::size_t tested = 0, crossed = 0;
};

struct ShadowVolumeResult {
  /// One a receiver; 1 where there is none.
  std::vector<float> visibility;
  StageTimes stages;
  ShadowVolumeCounts counts;
};

/// `threads`: to work on; the result does not depend on their number. Cost O(faces log faces), and for each
/// receiver the polygons near its line. Throws Cancelled.
ShadowVolumeResult shadow_volumes(const Scene& scene, const LightShape& light, const Receivers& receivers,
                                  const ShadowVolumeOptions& options, tbb::task_arena& threads,
                                  const Progress& progress);

}  // namespace penumbra
