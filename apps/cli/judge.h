// compare --judge double: visibility at some pixels by the oracle, rays in double that share nothing with render.
#pragma once

#include <cstdint>
#include <vector>

#include "penumbra/mesh/progress.h"
#include "penumbra/render/receivers/surface_buffer.h"
#include "penumbra/render/scene/scene.h"
#include "tests/oracle/oracle.h"

namespace penumbra::apps {

class Judge {
 public:
  /// Refers to the scene. Cost O(F log² F) for the casters' F faces.
  Judge(const Scene& scene, const DiskLight& light);

  /// V of these pixels by so many rays each, in their order. Nothing is moved off the surface; a pixel's own face
  /// hides nothing from it. Cost some microseconds a ray, on all cores. Throws Cancelled.
  std::vector<float> visibility(const SurfaceBuffer& surface, const std::vector<std::uint32_t>& pixels,
                                int samples, std::uint64_t seed, const Progress& progress) const;

 private:
  DiskLight light_;
  std::vector<std::int32_t> caster_of_;  ///< of the scene's objects; -1: it does not cast
  oracle::Oracle oracle_;
};

/// `count` of the pixels, chosen by chance, ascending; all where there are no more.
std::vector<std::uint32_t> some_of(std::vector<std::uint32_t> pixels, std::size_t count);

}  // namespace penumbra::apps
