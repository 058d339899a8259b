// What a picture shows beyond its lights: fill light, fading, shadow catchers.
#pragma once

#include <glm/geometric.hpp>

#include "penumbra/render/scene/scene.h"

namespace penumbra::detail {

/// What a surface sees of a sky of radiance 1 above a ground of radiance 1/2, cosine-weighted, over π: its
/// normal's half-space holds (1 + n·up) / 2 of the one and the rest of the other.
inline double sky_factor(const Vec3& normal, const Vec3& up) {
  return 0.25 * (3.0 + glm::dot(normal, up));
}

/// ITU-R BT.709, of linear RGB.
inline double luminance(const Vec3& color) {
  return glm::dot(color, Vec3(0.2126, 0.7152, 0.0722));
}

/// How opaque an object is at a point: 1 up to `from`, 0 beyond `to`, and 3t² - 2t³ between. 1 where it does
/// not fade.
double opacity_at(const SceneObject::Fade& fade, const Vec3& middle, const Vec3& point);

/// How opaque a shadow catcher is that gets `with` of light and would get `without` shadow. 0 where it would
/// get none.
double catcher_opacity(const Vec3& with, const Vec3& without);

}  // namespace penumbra::detail
