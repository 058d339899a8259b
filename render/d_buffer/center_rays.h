// D-buffer steps 1 and 8: rays from surface points to the light's center, and to sixteen points of the disk.
//
// In: surface points (once per camera), a light. Out: a number a pixel. Which entries a receiver reads
// depends on whether it sees the light's center. The 2004 paper decides that for a texel, by a shadow map; a
// ray decides it for the receiver.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "penumbra/render/receivers/receivers.h"
#include "penumbra/volumes/disk_light.h"
#include "render/rays/ray_scene.h"

namespace penumbra {
namespace detail {
struct ReceiverLanes;
}

class CenterRays {
 public:
  /// Copies what it needs of `surface`; `rays` must outlive it.
  CenterRays(const Receivers& surface, const RayScene& rays);
  /// Writes one number per pixel to `out`: 0 where a caster lies between the surface point and the disk's
  /// center, else 1. If the center is below the point's horizon but part of the disk is above it, the middle
  /// of that part takes the center's place. 1 behind the light, and where all of the disk is below the
  /// horizon. Cost: one ray a pixel, on all cores.
  void center_seen(const CircularLight& light, std::vector<float>& out) const;
  /// Visibility of each of the given pixels, all of which see a surface. It is the disk's fraction above the
  /// horizon, times the part that is seen of sixteen points on the disk, those below the horizon left out.
  /// Nine patterns of points alternate over three by three pixels (interleaved sampling, A. Keller and W.
  /// Heidrich 2001). Where one edge crosses the disk, the root mean square error over all chords is .037 for
  /// one pattern (at most .14) and .007 for the mean of nine. Cost: sixteen rays a pixel, on all cores.
  std::vector<float> sampled_visibility(const CircularLight& light,
                                        std::span<const std::uint32_t> pixels) const;

 private:
  detail::ReceiverLanes lanes(std::size_t first) const;

  const RayScene& rays_;
  /// Of the image.
  std::size_t pixels_;
  std::uint32_t width_;
  /// The pixels that see a surface, block by block, so that the rays of a packet run alike.
  std::vector<std::uint32_t> pixel_;
  /// Of each pixel its place in pixel_.
  std::vector<std::uint32_t> place_;
  /// Receivers in the world, normals, and the faces that they lie on; padded to whole packets.
  std::vector<double> x_, y_, z_, nx_, ny_, nz_;
  std::vector<std::int32_t> object_;
  std::vector<std::uint32_t> face_;
};

}  // namespace penumbra
