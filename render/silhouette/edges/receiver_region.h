// Silhouette method, step edges: a few receivers and the light together, as a test of a whole scene's
// hierarchies.
//
// In: the planes around the receivers and the disk, the receivers, their normals; all in the frame of rays.
// Out: a test for `BoundsTree` that drops blocks of edges that matter to none of these receivers. It serves
// where few receivers are left, so that looking for their edges costs less than making the light's band.
#pragma once

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

#include "mesh/vectors.h"
#include "render/silhouette/edges/bounds_tree.h"
#include "render/silhouette/edges/plane_lanes.h"

namespace penumbra::detail {

/// Drops blocks outside of a convex region, blocks below the receivers' tangent planes, and blocks whose
/// planes have one sign for all receivers. Made by `Shaft::region`. Coordinates of edges are up to 1; margins
/// grow with those of the receivers.
class ReceiverRegion {
 public:
  /// As many as a `Shaft` has.
  static constexpr std::size_t kPlanes = 17;
  struct Plane {
    Vec3 normal;  ///< unit
    double offset;
  };
  ReceiverRegion() = default;
  /// Planes are more than 0 outside. `middle` and `half`: the box of the receivers.
  ReceiverRegion(const std::array<Plane, kPlanes>& planes, const Vec3& middle, const Vec3& half)
      : grain_(kBoundsGrain * std::max(4.0, largest_component(middle) + largest_component(half))),
        receivers_(middle, half + grain_) {
    for (std::size_t k = 0; k < kPlanes; ++k)
      planes_[k] = FloatPlane(planes[k].normal, planes[k].offset - grain_);
  }
  /// Also drops what is below all tangent planes: normal·(p - m) < lowest for all normals of a box, m the
  /// middle of the receivers. `middle` and `half`: the box of the normals.
  void add_horizon(const Vec3& middle, const Vec3& half, double lowest) {
    normals_ = FloatBox(middle, half + kBoundsGrain);
    lowest_ = static_cast<float>(lowest - grain_);
  }
  /// Bit i is set where block i is dropped.
  PENUMBRA_INLINE std::uint32_t dropped(const Children& c) const {
    Ints out = are_one_sided(c, receivers_);
    for (const FloatPlane& p : planes_) out |= p.has_outside(c);
    return bits_of(out | are_below(c, receivers_, normals_, lowest_) |
                   are_under(c, receivers_, normals_, lowest_));
  }
  /// One of the receivers.
  class Point {
   public:
    Point(const Vec3& at, const Vec3& normal)
        : at_(at),
          normal_(normal),
          reach_(std::max(1.0, largest_component(at))),
          split_(at),
          box_(at, Vec3(kPointGrain * reach_)),
          normals_(normal, Vec3(kPointGrain)) {}
    const SplitPoint& at() const { return split_; }
    /// A point is certain to lie below the receiver's tangent plane.
    bool is_below(const Vec3& p) const { return glm::dot(normal_, p - at_) < -0x1p-44 * reach_; }
    /// Bit i is set where block i is one-sided, or below the tangent plane.
    PENUMBRA_INLINE std::uint32_t dropped(const Children& c) const {
      const float lowest = -16.0f * kPointGrain * static_cast<float>(reach_);
      return bits_of(are_one_sided(c, box_) | are_below(c, box_, normals_, lowest) |
                     are_under(c, box_, normals_, lowest));
    }

   private:
    /// Accuracy. What rounding to float adds to a coordinate. Held by the test
    /// ReceiverRegion.LoseNothingThatAReceiverSees.
    static constexpr float kPointGrain = 0x1p-23f;
    Vec3 at_, normal_;
    double reach_;
    SplitPoint split_;
    FloatBox box_, normals_;
  };
  void add_receiver(const Vec3& at, const Vec3& normal) { points_.emplace_back(at, normal); }
  const std::vector<Point>& receivers() const { return points_; }

 private:
  double grain_ = 4.0 * kBoundsGrain;
  FloatBox normals_;
  float lowest_ = -std::numeric_limits<float>::infinity();
  std::array<FloatPlane, kPlanes> planes_;
  FloatBox receivers_;
  std::vector<Point> points_;
};

std::size_t keep(const ReceiverRegion& test, const Children* nodes, const NodeMask* in, std::size_t count,
                 NodeMask* out);
/// Of some children of a node those that a receiver does not drop, as bits.
std::uint32_t kept_by(const ReceiverRegion::Point& receiver, const Children* nodes, const NodeMask& mask);

}  // namespace penumbra::detail
