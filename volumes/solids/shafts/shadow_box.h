// Solids: where in a bound something of a light may be hidden.
#pragma once

#include "volumes/solids/shafts/caster_tree.h"

namespace penumbra::detail {

/// Whether no caster hides any of the light from any point of a box. False where that is not proved, and
/// where the box is not strictly in front of the light's plane, unless it is wholly behind.
class LitBoxes {
 public:
  LitBoxes(const CasterTree& tree, const CircularLight& light, const Bounds& bound);
  bool is_lit(const Bounds& box) const;
  /// The least box that holds all parts of the bound that are not proved to be lit; parts are `bound` halved
  /// `depth` times along each axis.
  Bounds shadow_box(int depth) const;
  double extent() const { return extent_; }

 private:
  void visit(const Bounds& box, int depth, Bounds& out) const;

  const CasterTree& tree_;
  const CircularLight light_;
  const LightFrame frame_;
  Bounds bound_;
  double extent_;
};

}  // namespace penumbra::detail
