// Silhouette method, step 2 of 5: which band edges a tile of receivers has to look at.
//
// In: the band, and up to 64 neighboring receivers. Out: the edges that may be a silhouette across the disk
// for one of them; what is left out certainly is none. An edge is left out where
//  - it lies outside of a plane that bounds the receivers and the disk together (`Shaft`),
//  - it lies below the tangent planes of all receivers, where those cut the disk,
//  - its faces keep their sides for all receivers, and its jump is 0.
// The same tests run over a tree of boxes first (band_tree.h), so that the cost of a tile follows what
// it keeps.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "render/rays/ray_scene.h"
#include "render/silhouette/areas/disk_part.h"
#include "render/silhouette/collect/light_band.h"
#include "render/silhouette/edges/receiver_region.h"

namespace penumbra::detail {

inline constexpr int kShaftSides = 16;

/// A receiver in the light's frame: in front of the light, and with some of it above the horizon.
struct TileReceiver {
  Vec3 x, normal;
  Chord horizon;  ///< no_horizon where all of the disk is above the tangent plane
  bool horizon_cuts = false;
  std::uint32_t index = 0;  ///< of the receiver
};

/// A convex region that holds the disk and all receivers: z ≤ top, and for 16 directions d around the light
/// the plane d·(p.x, p.y) ≤ 1 + slope·p.z, which touches the disk and the receivers. With `horizon` also
/// everything that is below all tangent planes counts as outside. Signs are decided with a margin, so that
/// rounding keeps an edge rather than losing it.
class Shaft {
 public:
  /// By the box of the receivers: loose, but cheap.
  Shaft(std::span<const TileReceiver> receivers, double extent);
  /// By the receivers themselves.
  void tighten(std::span<const TileReceiver> receivers);

  bool misses(const Vec3& low, const Vec3& high) const;
  bool misses(const BandEdge& edge) const;

  /// Plane k of the shaft, 0 to kShaftSides: normal·p + offset ≤ 0 inside; the last is the top.
  struct Side {
    Vec3 normal;
    double offset;
  };
  Side side_plane(int k) const;
  /// The same for the frame of rays, and always with the receivers' horizons: what lies below them all hides
  /// nothing of what is above.
  ReceiverRegion region(std::span<const TileReceiver> receivers, const UnitLight& light,
                        const RayFrame& frame) const;
  const Vec3& middle() const { return middle_; }
  const Vec3& half() const { return half_; }
  struct Horizons {
    Horizons() = default;
    Horizons(std::span<const TileReceiver> receivers, const Vec3& middle);
    Vec3 low{0.0}, high{0.0};  ///< box of all receivers' normals
    double lowest = 0.0;       ///< the least normal·(receiver - middle)
  };
  /// Some receiver's horizon cuts the disk, and of a tightened shaft then all horizons.
  bool has_horizon() const { return horizon_; }
  const Horizons& horizons() const { return horizons_; }

 private:
  bool below_horizons(const Vec3& p) const;

  alignas(64) std::array<double, kShaftSides> slope_;
  double top_, margin_;
  Vec3 middle_, half_;  ///< box of the receivers
  bool horizon_ = false;
  Horizons horizons_;
};

}  // namespace penumbra::detail
