// Where most receivers are: where coordinates that are made for them have their origin.
#pragma once

#include "penumbra/render/receivers/receivers.h"

namespace penumbra::detail {

/// A place near which most receivers are, and how far from it: medians, so that a few that are far away do
/// not matter.
struct ReceiverMiddle {
  Vec3 middle{0.0};
  /// Scene units.
  double reach = 0.0;

  /// How far the origin of a LightProjection is in front of the light at least: where the light's plane runs
  /// through the receivers. It sets no limit to what is seen.
  double least_depth() const { return reach > 0.0 ? 0x1p-6 * reach : 1.0; }
};

/// Of the receivers that are present, by about a thousand of them. Cost O(1).
ReceiverMiddle receiver_middle(const Receivers& receivers);

}  // namespace penumbra::detail
