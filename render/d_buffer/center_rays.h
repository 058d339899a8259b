// D-buffer steps 1 and 8: rays from surface points to the light's center, and to points all over the disk.
//
// In: surface points (once per camera), a light. Out: what a pixel sees. Which entries a receiver reads
// depends on whether it sees the light's center. The 2004 paper decides that for a texel, by a shadow map; a
// ray decides it for the receiver.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "penumbra/render/receivers/receivers.h"
#include "penumbra/volumes/disk_light.h"
#include "render/light/disk_samples.h"
#include "render/rays/ray_scene.h"

namespace penumbra {
namespace detail {
struct ReceiverLanes;
}

/// Points of the unit disk, and a bit for each.
struct SeenPoints {
  std::span<const detail::DiskPoint> points;
  /// Above the receiver's horizon; of those, seen.
  std::uint16_t traced = 0, seen = 0;
};

class CenterRays {
 public:
  /// Copies what it needs of `surface`; `rays` must outlive it.
  CenterRays(const Receivers& surface, const RayScene& rays);
  /// Writes one number per pixel to `out`: 0 where a caster lies between the surface point and the disk's
  /// center, else 1. If the center is below the point's horizon but part of the disk is above it, the middle
  /// of that part takes the center's place. 1 behind the light, and where all of the disk is below the
  /// horizon. Cost: one ray a pixel, on all cores.
  void center_seen(const CircularLight& light, std::vector<float>& out) const;
  /// Nine patterns of sixteen points on the disk alternate over three by three pixels (interleaved sampling,
  /// A. Keller and W. Heidrich 2001). The share of the points on one side of a chord is off by .037 (root
  /// mean square over all chords) for one pattern, at most by .14, and by .007 for the mean of nine.
  static constexpr std::size_t kPatterns = 9;
  static std::span<const detail::DiskPoint> points(std::size_t pattern);
  /// Which points of its pattern each of the given pixels sees, all of which see a surface. Cost: sixteen
  /// rays a pixel, on all cores.
  std::vector<SeenPoints> seen_points(const CircularLight& light,
                                      std::span<const std::uint32_t> pixels) const;
  /// The same for all patterns: kPatterns a pixel, pixel by pixel.
  std::vector<SeenPoints> all_seen_points(const CircularLight& light,
                                          std::span<const std::uint32_t> pixels) const;

 private:
  detail::ReceiverLanes lanes(std::size_t first) const;
  SeenPoints look(const CircularLight& light, std::uint32_t pixel, std::size_t pattern) const;

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
