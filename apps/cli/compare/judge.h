// compare --judge double: what the oracle sees of a scene. Rays in double that share nothing with render, its
// camera included: of a scene only numbers are taken.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "penumbra/mesh/progress.h"
#include "penumbra/render/receivers/surface_buffer.h"
#include "penumbra/render/scene/scene.h"
#include "tests/oracle/oracle.h"

namespace penumbra::apps {

/// What the camera sees at the centers of a picture's pixels. Points lie in the planes of their faces, as far
/// as double can tell. Cost O(F log² F) for F faces and some microseconds a pixel, on all cores.
SurfaceBuffer surface_by_oracle(const Scene& scene, int width, int height);

class Judge {
 public:
  /// Cost O(F log² F) for the casters' F faces.
  Judge(const Scene& scene, const LightShape& light);

  /// V of these pixels by so many rays each, in their order. Nothing is moved off the surface; a pixel's own
  /// face hides nothing from it. Cost some microseconds a ray, on all cores. Throws Cancelled.
  std::vector<float> visibility(const SurfaceBuffer& surface, std::span<const std::uint32_t> pixels,
                                int samples, std::uint64_t seed, const Progress& progress = {}) const;
  /// O in the same way.
  std::vector<float> unoccluded(const SurfaceBuffer& surface, std::span<const std::uint32_t> pixels,
                                int samples, std::uint64_t seed, const Progress& progress = {}) const;
  /// Those of the pixels, certified lit (region 0) or in umbra (2), of which a ray finds the contrary.
  /// `region` has one entry a pixel of the picture.
  std::vector<std::uint32_t> contradicted(const SurfaceBuffer& surface, std::span<const std::uint32_t> pixels,
                                          std::span<const float> region, int samples, std::uint64_t seed,
                                          const Progress& progress = {}) const;

 private:
  std::optional<oracle::CasterFace> own_face(const SurfaceBuffer& surface, std::uint32_t pixel) const;

  oracle::Light light_;
  std::vector<std::int32_t> caster_of_;  ///< of the scene's objects; -1: it does not cast
  oracle::Oracle oracle_;
};

/// `count` of the pixels, chosen by chance, ascending; all where there are no more.
std::vector<std::uint32_t> some_of(std::vector<std::uint32_t> pixels, std::size_t count);

}  // namespace penumbra::apps
