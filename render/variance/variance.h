// The method variance: percentage-closer soft shadows from means and variances of depths.
//
// In: casters, a light, receivers. Out: V of each receiver, by a shadow map of the light's center alone, with
// a number of look-ups that does not depend on the light's size.
//
//   1. map     what the center sees first (center_view/shadow_map.h), and summed-area tables of its depths
//              (moment_table.h)
//   2. search  the mean depth z of the window that the light covers of the highest caster's plane, and the
//              share p of it that is not nearer to the light than the receiver: the blocker's depth is (z - p
//              z_receiver) / (1 - p)
//   3. filter  that share, of the window that the light covers of the blocker's plane
//
// The share is Chebyshev's bound, p = σ² / (σ² + (e - μ)²) for a warped depth e of the receiver beyond the
// mean μ, else 1; the lesser one of two warps. It is exact where a flat blocker and a flat receiver are
// parallel to the light, and else too large: light leaks.
//
// W. Donnelly, A. Lauritzen, "Variance shadow maps" (2006); A. Lauritzen, M. McCool, "Layered variance shadow
// maps" (2008), for the exponential warp; B. Yang and others, "Variance soft shadow mapping" (2010), for step
// 2; "Casting Shadows in Real Time" (2009), sections 4.2 and 5.2.2. A disk counts as a square of its area.
#pragma once

#include <tbb/task_arena.h>

#include <vector>

#include "penumbra/mesh/progress.h"
#include "penumbra/mesh/stage_clock.h"
#include "penumbra/render/method.h"
#include "penumbra/render/receivers/receivers.h"
#include "penumbra/render/scene/scene.h"
#include "render/light/area_light.h"

namespace penumbra {

struct VarianceOptions {
  /// Texels a side of the map.
  int map_size = 1024;
  /// c of the warps exp(c z) and -exp(-c z); 0: no warp.
  double warp = 8.0;
  /// Shares up to this count as hidden, and the rest is stretched.
  double least_share = 0.0;
};

/// Requires a light that is no point. The horizon is a factor of its own. Cost O(faces + texels), and O(1) a
/// receiver. On all threads; the result does not depend on their number. Throws Cancelled.
MethodResult variance_visibility(const Scene& scene, const AreaLight& light, const Receivers& receivers,
                                 const VarianceOptions& options, bool keep_textures, tbb::task_arena& threads,
                                 const Progress& progress);

}  // namespace penumbra
