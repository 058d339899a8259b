// Planes that have a light and receivers on one side, and a caster on the other: proofs that the caster hides
// nothing.
//
// Let R be a box of receivers, D the light's disk and B a caster's box. Where a plane has conv(R ∪ D) on one
// side and B on the other, no segment from a receiver to the light meets B. Tried are
//
//   sixteen sides    n = d - s w with d a direction in the light's plane, w its normal, z = w·(p - c) the
//                    depth before it: n·(p - c) ≤ r on the disk, and on R with s = max over R of (d·(p - c) -
//                    r) / z. Of a distant light of tangent t: n = d + t w, n·p ≤ max over R.
//   behind           w·p ≤ max over R: what lies farther from the light than all receivers.
//   the axes         ± x, y, z.
//
// Sums are in double with a margin far above their rounding: a caster that is left out is strictly apart.
// Rectangles are taken by the smallest disk around them.
#pragma once

#include <array>

#include "penumbra/render/light/light.h"
#include "render/plan/receiver_boxes.h"

namespace penumbra::detail {

class LightSides {
 public:
  explicit LightSides(const CircularLight& light);

  /// None of the box is in front of the light's plane.
  bool is_behind(const Bounds& box) const;
  /// No receiver of the box sees any of the light: it lies behind the light's plane or, where `horizon` and
  /// it has normals, faces away from all of the light.
  bool is_dark(const ReceiverBox& box, bool horizon) const;
  /// No segment from a point of the receivers' box to a point of the light meets the caster's box. Only for
  /// points in front of the light's plane; false where some are not clearly so. Cost: some hundred flops.
  bool separates(const Bounds& receivers, const Bounds& caster) const;

 private:
  static constexpr int kSides = 16;

  /// A box relative to `origin_`, by its middle and half its size.
  struct Box {
    Vec3 middle, half;
    double reach;  ///< the largest coordinate
  };
  Box box_of(const Bounds& bounds) const;
  bool separates_by_side(const Vec3& d, const Box& receivers, double near, double far,
                         const Box& caster) const;
  bool separates_by_axis(int axis, const Box& receivers, const Box& caster) const;

  bool distant_;
  Vec3 origin_;  ///< the center; of a distant light 0
  Vec3 normal_;
  double radius_;  ///< of a distant light tan(angle/2)
  std::array<Vec3, kSides> sides_;
};

}  // namespace penumbra::detail
