// Solids: the shaft of a convex set T of points and a circular light D, conv(T ∪ D): all segments that join
// the two.
//
// A face that misses the shaft of T hides nothing from any point of T, and a T whose shaft no face meets is
// wholly lit. That is exact, since the union of all segments between two convex sets is the hull of both.
//
// Beyond all casters the shaft is cut off: with the light's center c, its height H0 over T's first point o,
// and λ = min(1, 2·extent/H0), it ends in (1 - λ)T + λD. Numbers then are as large as casters are, at any
// distance of the light; a distant light is the limit λ = 0.
#pragma once

#include <array>
#include <span>

#include "penumbra/mesh/types.h"
#include "penumbra/volumes/disk_light.h"

namespace penumbra::detail {

class LightShaft {
 public:
  static constexpr int kMostPoints = 8;
  static constexpr int kSides = 16;

  /// T is the hull of the points, 1 to kMostPoints of them, strictly in front of the light's plane. `extent`:
  /// nothing that is asked about lies farther from them.
  LightShaft(const CircularLight& light, const LightFrame& frame, std::span<const Vec3> points,
             double extent);

  /// True only where the box lies outside, by a plane that bounds the shaft. May miss that.
  bool misses_box(const Vec3& low, const Vec3& high) const;
  /// True only where the triangle lies outside: a plane separates it from the shaft by more than rounding.
  /// Finds all such planes but for those that leave less than 1e-9 of the extent. An edge is a triangle with
  /// two equal corners.
  bool misses(const Vec3& a, const Vec3& b, const Vec3& c) const;
  /// As bits, those of some planes that bound the shaft beyond which a point lies. What has points that share
  /// a bit misses the shaft.
  std::uint32_t sides_beyond(const Vec3& p) const;
  /// True only where the point lies in the shaft of the first of T's points, but for rounding.
  bool holds(const Vec3& p) const;
  /// The same as `misses` for T alone instead of its shaft.
  bool base_misses(const Vec3& a, const Vec3& b, const Vec3& c) const;

 private:
  struct Side {
    Vec3 normal;
    double offset;
  };
  /// The point of the shaft, or of T alone, that is farthest along v; relative to the origin.
  Vec3 farthest(const Vec3& v, bool base_only) const;
  bool is_separate(const std::array<Vec3, 3>& triangle, bool base_only) const;
  bool is_beyond_a_side(const std::array<Vec3, 3>& triangle) const;

  Vec3 origin_;
  std::array<Vec3, kMostPoints> points_;  ///< relative to the origin
  int count_;
  Vec3 axis_;      ///< the light's unit normal
  Vec3 end_;       ///< λ(c - o)
  double radius_;  ///< λr
  double kept_;    ///< 1 - λ
  double margin_;  ///< of a distance along a unit normal
  std::array<Side, kSides + 1> sides_;
  Vec3 base_low_, base_high_;  ///< of T, world
};

}  // namespace penumbra::detail
