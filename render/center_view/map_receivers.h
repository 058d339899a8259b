// Methods with a shadow map of the light's center: receivers in the coordinates of the map.
//
// In: receivers, a LightProjection. Out: where each one is in (q, h), the plane that it lies in there, and
// the window of the map in which receivers look.
#pragma once

#include <glm/vec2.hpp>
#include <optional>

#include "penumbra/render/receivers/receivers.h"
#include "render/center_view/shadow_map.h"
#include "render/light/area_light.h"

namespace penumbra::detail {

struct MapReceiver {
  glm::dvec2 place;
  double height;
  /// Of the receiver's plane: how much it rises, at most kSteepest.
  glm::dvec2 rise{0.0};
};

/// Accuracy. Steeper planes than this are not followed: the receiver sees the light edge-on.
inline constexpr double kSteepest = 50.0;

/// Nothing where the receiver is not in front of the light.
std::optional<MapReceiver> to_map(const LightProjection& projection, const Receivers& receivers,
                                  std::size_t i);

/// All receivers, and the light as each of them sees it at the height `top`. Cost O(receivers).
MapWindow seen_window(const LightProjection& projection, const Receivers& receivers, double top);

/// The part of the casters' window that receivers look at; it may be empty.
MapWindow looked_at(const CasterReach& casters, const LightProjection& projection,
                    const Receivers& receivers);

/// The fraction of the light that the receiver's horizon leaves; 0 behind the light.
double above_horizon(const AreaLight& light, const Receivers& receivers, std::size_t i);

}  // namespace penumbra::detail
