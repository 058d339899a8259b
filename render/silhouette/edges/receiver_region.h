// A tile's receivers and the light together, in the frame of rays: where hierarchies of a whole scene are
// asked for the few edges that matter to a tile.
#pragma once

#include <array>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

#include "render/silhouette/edges/bounds_tree.h"
#include "render/silhouette/edges/plane_lanes.h"

namespace penumbra::detail {

/// Drops blocks outside of a convex region, and those whose planes have one sign for all receivers.
class ReceiverRegion {
 public:
  static constexpr std::size_t kPlanes = 17;
  struct Plane {
    Vec3 normal;  ///< unit
    double offset;
  };
  ReceiverRegion() = default;
  /// Planes are more than 0 outside; `middle` and `half`: the box of the receivers. For coordinates up to 1,
  /// and for receivers up to 4.
  ReceiverRegion(const std::array<Plane, kPlanes>& planes, const Vec3& middle, const Vec3& half)
      : receivers_(middle, half + kBoundsGrain) {
    for (std::size_t k = 0; k < kPlanes; ++k)
      planes_[k] = FloatPlane(planes[k].normal, planes[k].offset - 4.0 * kBoundsGrain);
  }
  /// Also drops what is below all tangent planes: normal·(p - middle) < lowest for all normals of a box.
  void add_horizon(const Vec3& middle, const Vec3& half, double lowest) {
    normals_ = FloatBox(middle, half + kBoundsGrain);
    lowest_ = static_cast<float>(lowest - 4.0 * kBoundsGrain);
  }
  /// Bit i is set for block i.
  PENUMBRA_INLINE std::uint32_t dropped(const Children& c) const {
    Ints out = are_one_sided(c, receivers_);
    for (const FloatPlane& p : planes_) out |= p.has_outside(c);
    return bits_of(out | are_below(c, receivers_, normals_, lowest_) |
                   are_under(c, receivers_, normals_, lowest_));
  }
  /// The receivers themselves.
  class Point {
   public:
    Point(const Vec3& at, const Vec3& normal)
        : at_(at),
          normal_(normal),
          split_(at),
          box_(at, Vec3(kPointGrain)),
          normals_(normal, Vec3(kPointGrain)) {}
    const SplitPoint& at() const { return split_; }
    bool is_below(const Vec3& p) const { return glm::dot(normal_, p - at_) < -0x1p-44; }
    /// Bit i is set for block i: one-sided, or below the tangent plane.
    PENUMBRA_INLINE std::uint32_t dropped(const Children& c) const {
      constexpr float kLowest = -16.0f * kPointGrain;
      return bits_of(are_one_sided(c, box_) | are_below(c, box_, normals_, kLowest) |
                     are_under(c, box_, normals_, kLowest));
    }

   private:
    static constexpr float kPointGrain = 0x1p-23f;
    Vec3 at_, normal_;
    SplitPoint split_;
    FloatBox box_, normals_;
  };
  void add_receiver(const Vec3& at, const Vec3& normal) { points_.emplace_back(at, normal); }
  const std::vector<Point>& receivers() const { return points_; }

 private:
  FloatBox normals_;
  float lowest_ = -std::numeric_limits<float>::infinity();
  std::array<FloatPlane, kPlanes> planes_;
  FloatBox receivers_;
  std::vector<Point> points_;
};

std::size_t keep(const ReceiverRegion& test, const Children* nodes, const NodeMask* in, std::size_t count,
                 NodeMask* out);
/// Those of eight siblings that a receiver may have to look at.
std::uint32_t kept_by(const ReceiverRegion::Point& receiver, const Children* nodes, const NodeMask& mask);

}  // namespace penumbra::detail
