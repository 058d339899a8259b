// The method view-samples: light samples hidden by the masks of half-planes, face by face; no silhouettes, no
// rays.
//
// In: casters, a light, receivers, how many light samples. Out: V of each receiver, the fraction of its
// samples that no face hides. Its samples are those of the method `reference`: both agree but where a ray
// grazes an edge within rounding.
//
//   1. faces  those that reach between a tile of receivers and the light (face_tree.h); long lists again for
//             parts of the tile
//   2. masks  each face hides the samples within three half-planes (sample_masks.h)
//
// S. Laine, T. Aila, "Hierarchical penumbra casting" (2005); E. Eisemann, X. Décoret, "Visibility sampling on
// GPU and applications" (2007); E. Sintorn, E. Eisemann, U. Assarsson, "Sample-based visibility for soft
// shadows using alias-free shadow maps" (2008); "Casting Shadows in Real Time" (2009), section 5.3.3. They
// look masks up in a table by the line's angle and distance, which moves edges by the table's grain. Here
// every sample is compared with every line.
#pragma once

#include <tbb/task_arena.h>

#include <cstdint>
#include <vector>

#include "penumbra/mesh/progress.h"
#include "penumbra/mesh/stage_clock.h"
#include "penumbra/render/receivers/receivers.h"
#include "penumbra/render/scene/scene.h"

namespace penumbra {

struct ViewSampleOptions {
  /// As of the reference (rays/reference.h): samples a receiver, and their stream.
  int samples = 256;
  std::uint64_t seed = 1;
  /// false: nothing lies below a horizon; V is then O.
  bool horizon = true;
};

/// What was done for one light. Sums are over receivers unless said otherwise.
struct ViewSampleCounts {
  /// Of the casters, in front of the light.
  std::size_t faces = 0;
  /// In front of the light, with some of it above the horizon.
  std::size_t receivers = 0;
  /// Faces that receivers looked at, and of these those that hide some samples, and that hide all.
  std::size_t listed_faces = 0, masks = 0, covers = 0;
};

struct ViewSampleResult {
  /// One a receiver; 1 where there is none.
  std::vector<float> visibility;
  StageTimes stages;
  ViewSampleCounts counts;
};

/// Requires a light that is no point. Cost: the faces, those near each tile, and for each receiver n samples
/// times the faces across its light. On all threads; the result does not depend on their number. Throws
/// Cancelled.
ViewSampleResult view_sample_visibility(const Scene& scene, const LightShape& light,
                                        const Receivers& receivers, const ViewSampleOptions& options,
                                        tbb::task_arena& threads, const Progress& progress);

}  // namespace penumbra
