// Whether something hides the light's center from each receiver, by one ray a pixel.
//
// In: surface points (once), a light. Out: a byte a pixel. The shadow's whole topology hangs on this sign (see
// d_buffer.h), and a ray decides it for the receiver itself, where a shadow map decides it for a texel.
#pragma once

#include <cstdint>
#include <vector>

#include "render/ray_scene.h"
#include "render/surface_buffer.h"

namespace penumbra {

class CenterRays {
 public:
  /// Copies what it needs of `surface`; `rays` must outlive it.
  CenterRays(const SurfaceBuffer& surface, const RayScene& rays);
  /// One per pixel of the surface buffer: 1 where a caster cuts the segment to the disk's center, or, where the
  /// center is below the receiver's horizon and part of the disk is above it, to the middle of that part's
  /// extent; 0 elsewhere. Points behind the light count as open. Cost: one ray a pixel, on all cores.
  std::vector<std::uint8_t> hidden(const DiskLight& light) const;

 private:
  const RayScene& rays_;
  std::size_t pixels_;                           ///< of the surface buffer
  std::vector<std::uint32_t> pixel_;             ///< that see a surface, in order
  std::vector<float> x_, y_, z_, nx_, ny_, nz_;  ///< ray origins and normals, local frame, padded to whole packets
};

}  // namespace penumbra
