// The method depth-complexity: light samples that silhouettes toggle, and one ray a receiver.
//
// In: casters, a light, receivers, how many light samples. Out: V of each receiver, the fraction of its
// samples that no face hides. That is what the method `reference` finds by one ray a sample, with the same
// samples: both agree but where a ray grazes a silhouette within rounding.
//
//   1. edges     the edges of the light's band that may cross the light for a tile of receivers
//                (silhouette/collect/), and of these the silhouettes of each receiver
//   2. counters  each silhouette, projected onto the light, changes the counters of the samples that lie
//                beyond it as seen from a start on the light, by its jump (sample_counters.h)
//   3. ray       one ray to a sample whose counter is lowest. Where it meets nothing all samples with that
//                counter are visible, and no others. Where it is blocked all of them are.
//
// S. Laine, T. Aila, U. Assarsson, J. Lehtinen, T. Akenine-Möller, "Soft shadow volumes for ray tracing"
// (2005), section 4; "Casting Shadows in Real Time" (2009), section 5.3. They go over a row of samples from
// left to right, and need closed silhouettes to the left of the light. Here the way to a sample is the
// segment from the start. It stays on the light, so edges beside the light have no part in it. Jumps are
// signs of planes at the receiver, so that casters may be open, not manifold or wound inconsistently.
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

struct DepthComplexityOptions {
  /// As of the reference (rays/reference.h): samples a receiver, and their stream.
  int samples = 256;
  std::uint64_t seed = 1;
  /// false: nothing lies below a horizon; V is then O.
  bool horizon = true;
};

/// What was done for one light. Sums are over receivers unless said otherwise.
struct DepthComplexityCounts {
  /// Of the casters.
  std::size_t faces = 0, mesh_edges = 0, band_edges = 0;
  /// In front of the light, with some of it above the horizon.
  std::size_t receivers = 0;
  /// Groups that have receivers.
  std::size_t tiles = 0;
  /// Edges that receivers looked at.
  std::size_t listed_edges = 0;
  /// Silhouettes across the light, and the counters that they changed.
  std::size_t segments = 0, toggled_samples = 0;
  std::size_t rays = 0;
  /// Of the band and its tree.
  std::size_t bytes = 0;
};

struct DepthComplexityResult {
  /// One a receiver; 1 where there is none.
  std::vector<float> visibility;
  StageTimes stages;
  DepthComplexityCounts counts;
};

/// `edges`: of the scene, in the frame of rays. Requires a light that is no point. Cost: the band, the band
/// edges near each tile, and for each receiver s·n for s silhouettes across the light and n samples. On all
/// threads of `rays`; the result does not depend on their number. Throws Cancelled.
DepthComplexityResult depth_complexity_visibility(const Scene& scene, const RayScene& rays,
                                                  const detail::SceneEdges& edges, const LightShape& light,
                                                  const Receivers& receivers,
                                                  const DepthComplexityOptions& options = {},
                                                  const Progress& progress = {});

}  // namespace penumbra
