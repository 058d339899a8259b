// Silhouette method, step collect: which edges a tile of receivers has to look at.
//
// In: up to 64 neighboring receivers. Out: a test of edges and boxes. What it drops is no silhouette across
// the disk for any of the receivers. An edge can be dropped where
//  - it lies outside of a plane that bounds the receivers and the disk together (`Shaft`),
//  - it lies below the tangent planes of all receivers, where those cut the disk,
//  - its faces are on the same sides for all receivers, and its jump is 0 (block_tests.h, edge_blocks.h,
//    edge_list.h).
// The same tests run over a tree of boxes first (band_tree.h), so that the cost of a tile follows what it
// keeps.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "render/rays/ray_scene.h"
#include "render/silhouette/collect/light_band.h"
#include "render/silhouette/collect/tile_receiver.h"
#include "render/silhouette/edges/receiver_region.h"

namespace penumbra::detail {

/// Speed. Directions of the sides of a shaft. More sides keep fewer edges and cost more for each. Seen in
/// the benchmark `silhouette`, stage receivers.
inline constexpr int kShaftSides = 16;

/// A convex region that holds the disk and all receivers: z ≤ top, and d·(p.x, p.y) ≤ 1 + slope · p.z for
/// 16 directions d around the light. Each of these sides touches the disk and the receivers. Where some
/// receiver's horizon cuts the disk, what lies below all tangent planes also counts as outside. Signs are
/// decided with a margin: rounding keeps an edge rather than losing it.
class Shaft {
 public:
  /// Around the box of the receivers: loose, but cheap. `extent`: the largest coordinate.
  Shaft(std::span<const TileReceiver> receivers, double extent);
  /// Around a box of the light's frame, wholly in front of the light.
  Shaft(const Bounds& box, double extent);
  /// Makes the sides touch the receivers themselves, and adds their horizons. Cost O(receivers).
  void tighten(std::span<const TileReceiver> receivers);

  /// A box, or an edge, lies outside.
  bool misses(const Vec3& low, const Vec3& high) const;
  bool misses(const BandEdge& edge) const;

  /// Side k of the shaft, 0 to kShaftSides: normal·p + offset ≤ 0 inside. The last is the top.
  struct Side {
    Vec3 normal;
    double offset;
  };
  Side side_plane(int k) const;
  /// The same shaft in the frame of rays, with the receivers' horizons in any case: what lies below all of
  /// them hides nothing of what lies above.
  ReceiverRegion region(std::span<const TileReceiver> receivers, const UnitLight& light,
                        const RayFrame& frame) const;
  /// The box of the receivers, by its middle and half its size.
  const Vec3& middle() const { return middle_; }
  const Vec3& half() const { return half_; }
  /// The receivers' tangent planes together.
  struct Horizons {
    Horizons() = default;
    Horizons(std::span<const TileReceiver> receivers, const Vec3& middle);
    /// The box of the normals.
    Vec3 low{0.0}, high{0.0};
    /// The least normal·(receiver - middle).
    double lowest = 0.0;
  };
  /// Some receiver's horizon cuts the disk. Known, with all `horizons`, after `tighten`.
  bool has_horizon() const { return horizon_; }
  const Horizons& horizons() const { return horizons_; }

 private:
  bool below_horizons(const Vec3& p) const;

  alignas(64) std::array<double, kShaftSides> slope_;
  double top_, margin_;
  Vec3 middle_, half_;
  bool horizon_ = false;
  Horizons horizons_;
};

}  // namespace penumbra::detail
