// The reference: visibility by stratified rays to the light, disk or rectangle (Embree), and the measure for
// everything else.
//
// In: surface points. Out: V per pixel, the fraction of the light that no caster hides and that is above the
// receiver's tangent plane. Samples are a jittered grid of strata mapped to the disk (the rectangle is a
// square already) by the concentric map of Shirley and Chiu (1997); the jitter is a hash of seed, pixel and
// stratum, so that the result does not depend on threads, and adding an object leaves the samples of pixels
// that see the same face alone.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "penumbra/mesh/progress.h"
#include "render/receivers/surface_buffer.h"

namespace penumbra {

struct ReferenceOptions {
  int samples =
      256;  ///< rays a pixel, 1 to 1,048,576; rounded up to ⌊√n⌋ rows of equal length (squares stay)
  std::uint64_t seed = 1;  ///< two seeds give two independent references
  bool packets = true;     ///< 16 rays at a time; false: one by one, to compare
};

struct ReferenceResult {
  std::vector<float> visibility;  ///< one per entry of `pixels`
  std::vector<float> unblocked;   ///< O: the same rays without the horizon test (only where asked for)
  int samples = 1;                ///< per pixel, after rounding up to whole strata
  std::size_t rays = 0;  ///< traced (those below the horizon are not, unless `unblocked` is asked for)
  double milliseconds = 0.0;
};

/// Pixels (indices into the surface buffer) that see no surface get 1. Points behind the light's plane get 0.
ReferenceResult trace_reference(const Scene& scene, const RayScene& rays, const SurfaceBuffer& surface,
                                std::span<const std::uint32_t> pixels, const ReferenceOptions& options,
                                bool with_unblocked = false, const Progress& progress = {});

/// The hard shadow: one ray to the disk's centre, with the horizon. The same conventions.
ReferenceResult trace_hard(const Scene& scene, const RayScene& rays, const SurfaceBuffer& surface,
                           std::span<const std::uint32_t> pixels);

}  // namespace penumbra
