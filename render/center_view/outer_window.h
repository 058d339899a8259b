// What the light's center sees, for methods that add a penumbra outside of a hard shadow.
//
// In: casters, a light, receivers. Out: the coordinates of their maps, and the window that holds casters and
// outer penumbras.
#pragma once

#include "render/center_view/map_options.h"
#include "render/center_view/map_receivers.h"

namespace penumbra::detail {

struct OuterPenumbra {
  /// Cost O(faces + receivers).
  OuterPenumbra(const Scene& scene, const AreaLight& light, const Receivers& receivers);

  LightProjection projection;
  /// Empty where no caster is nearer to the light than some receiver.
  MapWindow window;
  /// Of a disk as large as the light, in the units of the projection's spread.
  double radius;
  /// The least height of receivers, and the greatest of casters.
  double lowest = 1e300, top = -1e300;
};

/// A caster is nearer to the light than the receiver, by the texel there.
bool is_hidden(const ShadowMap& casters, const MapReceiver& receiver, const MapBias& bias);

}  // namespace penumbra::detail
