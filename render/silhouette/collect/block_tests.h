// Silhouette method, step collect: tests that drop blocks of edges by their bounds.
//
// In: the receivers of a shaft (`ShaftTest`), or one receiver (`ConeTest`). Out: tests for `BoundsTree`.
// What they drop is farther from the disk than the slack of the certificate (edges/projected_segment.h).
//
// All is in float with the margin of block_bounds.h, M being the extent of the scene in light radii, times
// 1 + (M + 1)/z where projection enlarges errors.
#pragma once

#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "render/silhouette/collect/shaft.h"
#include "render/silhouette/edges/block_bounds.h"

namespace penumbra::detail {

/// Drops blocks outside of a shaft, below its horizons, or with planes of one sign for all its receivers.
class ShaftTest {
 public:
  ShaftTest(const Shaft& shaft, double extent) : receivers_(shaft.middle(), shaft.half()) {
    const double margin = kBoundsGrain * extent;
    for (int k = 0; k <= kShaftSides; ++k) {
      const Shaft::Side side = shaft.side_plane(k);
      planes_[k] = FloatPlane(side.normal, side.offset - margin * (1.0 + std::abs(side.normal.z)));
    }
    has_horizon_ = shaft.has_horizon();
    if (!has_horizon_) return;
    const auto& [low, high, lowest] = shaft.horizons();
    normals_ = FloatBox(0.5 * (low + high), 0.5 * (high - low));
    lowest_ = static_cast<float>(lowest - margin);
  }
  /// Bit i is set where block i is dropped.
  PENUMBRA_INLINE std::uint32_t dropped(const Children& c) const {
    Ints out = are_one_sided(c, receivers_);
    for (const FloatPlane& p : planes_) out |= p.has_outside(c);
    if (has_horizon_) out |= are_below(c, receivers_, normals_, lowest_);
    return bits_of(out);
  }

 private:
  std::array<FloatPlane, kShaftSides + 1> planes_;
  FloatBox receivers_, normals_;
  bool has_horizon_ = false;
  float lowest_ = 0.0f;
};

/// Drops blocks for one receiver x: outside of the cone from x to the disk, |p.xy - x.xy p.z/x.z| > 1 -
/// p.z/x.z, below its tangent plane, or with planes of one sign at x.
class ConeTest {
 public:
  ConeTest() = default;
  ConeTest(const TileReceiver& receiver, double extent)
      : at_(receiver.x, Vec3(0.0)),
        per_z_(static_cast<float>(1.0 / receiver.x.z)),
        steep_((std::hypot(at_.middle[0], at_.middle[1]) + 1.0f) * per_z_),
        margin_(static_cast<float>(kBoundsGrain * extent) * (1.0f + steep_)),
        tangent_(-receiver.normal, glm::dot(receiver.normal, receiver.x) - kBoundsGrain * extent) {}
  /// Bit i is set where block i is dropped.
  PENUMBRA_INLINE std::uint32_t dropped(const Children& c) const {
    Ints out = are_one_sided(c, at_) | tangent_.has_outside(c);
    const Floats t = c.middle[2] * per_z_;
    const Floats x = c.middle[0] - at_.middle[0] * t, y = c.middle[1] - at_.middle[1] * t;
    const Floats reach = 1.0f - t + c.across + c.half[2] * steep_ + margin_;
    out |= (reach < 0.0f) | (x * x + y * y > reach * reach * 1.00001f);
    return bits_of(out);
  }

 private:
  FloatBox at_;
  float per_z_ = 0.0f, steep_ = 0.0f, margin_ = 0.0f;
  FloatPlane tangent_;
};

}  // namespace penumbra::detail
