// The reference: visibility by stratified rays to the light, and the measure for everything else.
//
// In: receivers, a light (disk or rectangle). Out: V of each, the fraction of the light that no caster hides
// and that is above the receiver's tangent plane. Samples are a jittered grid of strata mapped to the disk
// (the rectangle is a square already) by the concentric map of Shirley and Chiu (1997). The jitter is a hash
// of seed, receiver and stratum, so that the result does not depend on threads. A pixel is hashed by its
// place in the picture, any other receiver by its coordinates, so that its result does not depend on the
// order of receivers either. Adding an object leaves the samples of receivers alone.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "penumbra/mesh/progress.h"
#include "penumbra/render/light/light.h"
#include "penumbra/render/receivers/receivers.h"
#include "render/rays/ray_scene.h"

namespace penumbra {

struct ReferenceOptions {
  /// Rays a receiver, 1 to 1,048,576; rounded up to ⌊√n⌋ rows of equal length (squares stay).
  int samples = 256;
  /// Two seeds give two independent references.
  std::uint64_t seed = 1;
  /// 16 rays at a time; false: one by one, to compare.
  bool packets = true;
};

struct ReferenceResult {
  /// One for each receiver that was asked for, in their order.
  std::vector<float> visibility;
  /// O: the same rays without the horizon; only where asked for.
  std::vector<float> unoccluded;
  /// Rays a receiver, after rounding up to whole strata.
  int samples = 1;
  /// Traced. Those below the horizon are not, unless O is asked for.
  std::size_t rays = 0;
  double milliseconds = 0.0;
};

/// Of the receivers whose indices are given. 1 where there is no receiver, 0 behind the light's plane. A
/// light that is a point gets trace_hard. Throws UsageError for samples outside their range, Cancelled. Cost
/// O(receivers · samples · log faces), on all threads of `rays`.
ReferenceResult trace_reference(const RayScene& rays, const LightShape& light, const Receivers& receivers,
                                std::span<const std::uint32_t> indices, const ReferenceOptions& options,
                                bool with_unoccluded = false, const Progress& progress = {});

}  // namespace penumbra
