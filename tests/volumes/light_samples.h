// Points of a circular light, and places that its shadows do not reach, for oracles.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "penumbra/mesh/types.h"
#include "penumbra/volumes/disk_light.h"

namespace penumbra::testing {

/// Where a segment from x towards sample k of n of the disk ends (Vogel's spiral): at the sample, or, if the
/// light is distant, about `far` away.
inline Vec3 end_towards_light(const CircularLight& light, const LightFrame& frame, const Vec3& x, int k,
                              int n, double far) {
  const double angle = 2.399963229728653 * k, r = light.radius * std::sqrt((k + 0.5) / n);
  const Vec3 q = r * (std::cos(angle) * frame.u + std::sin(angle) * frame.v);
  return light.is_distant() ? x + far * (q - frame.w) : light.center + q;
}

/// A point that no shadow of what is in the box reaches: behind the light by `distance`, or, if the light is
/// distant, between it and the box.
inline Vec3 unshadowed_point(const CircularLight& light, const Bounds& box, double distance) {
  const Vec3 w = light_frame(light).w;
  return light.is_distant() ? box.center() - (box.radius() + distance) * w : light.center - distance * w;
}

/// For messages.
inline std::string text_of(const CircularLight& light) {
  const Vec3& p = light.center;
  return (light.is_distant() ? "light from (" : "light at (") + std::to_string(p.x) + ", " +
         std::to_string(p.y) + ", " + std::to_string(p.z) + "), radius " + std::to_string(light.radius);
}

}  // namespace penumbra::testing
