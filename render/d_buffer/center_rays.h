// Whether each receiver sees the light's center, by rays, and what a few more say of a penumbra.
//
// In: surface points (once), a light. Out: a number a pixel. The shadow's whole topology hangs on it (see
// d_buffer.h), and a ray decides it for the receiver itself, where a shadow map decides it for a texel.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "penumbra/render/receivers/receivers.h"
#include "render/rays/ray_scene.h"

namespace penumbra {
namespace detail {
struct ReceiverLanes;
}

class CenterRays {
 public:
  /// Copies what it needs of `surface`; `rays` must outlive it.
  CenterRays(const Receivers& surface, const RayScene& rays);
  /// Into `out` one per pixel of the surface buffer: 1 where nothing lies between it and the disk's center,
  /// else 0. Where the center is below the receiver's horizon and part of the disk is above it, the middle of
  /// that part's extent takes its place. Points behind the light and such that see nothing of it count as
  /// open. Cost: one ray a pixel, on all cores.
  void center_seen(const DiskLight& light, std::vector<float>& out) const;
  /// Visibility of each of the given pixels, all of which see a surface: the disk's fraction above the
  /// horizon, times the share that is seen of sixteen points of equal shares of the disk (of those above).
  /// Nine patterns of points alternate over three by three pixels (interleaved sampling, Keller and Heidrich
  /// 2001). Where one edge crosses the disk, one pattern errs by .037 (root mean square over all chords; at
  /// worst by .14), the mean of the nine by .007. Cost: sixteen rays a pixel, on all cores.
  std::vector<float> sampled_visibility(const DiskLight& light, std::span<const std::uint32_t> pixels) const;
  /// Into `out` one per pixel: the disk's area fraction above the receiver's horizon, 0 behind the light, 1
  /// where nothing is seen.
  void above_horizon(const DiskLight& light, std::vector<float>& out) const;

 private:
  detail::ReceiverLanes lanes(std::size_t first) const;

  const RayScene& rays_;
  std::size_t pixels_;                ///< of the surface buffer
  std::uint32_t width_;               ///< of the surface buffer
  std::vector<std::uint32_t> pixel_;  ///< that see a surface, in blocks
  std::vector<std::uint32_t> place_;  ///< of each pixel in pixel_
  std::vector<float> x_, y_, z_, nx_, ny_,
      nz_;  ///< ray origins and normals, local frame, padded to whole packets
};

}  // namespace penumbra
