// The frame of float stages: where rays and edges have their digits.
//
// Everything is moved to the light's center and scaled by a power of two to about unit size, so that float keeps
// its digits where shadows are decided.
#pragma once

#include "penumbra/render/scene/scene.h"

namespace penumbra {

/// local = (world - origin) · scale; scale is a power of two, so that only the translation rounds.
struct RayFrame {
  Vec3 origin{0.0};
  double scale = 1.0;
  bool operator==(const RayFrame&) const = default;
  Vec3 to_local(const Vec3& world) const { return (world - origin) * scale; }
};

/// The frame of objects under a light: origin at the light, bounds of objects and light scaled into [-1, 1].
RayFrame ray_frame(const Scene& scene, const LightShape& light);
/// The same under the scene's first light; about the objects where it has none.
RayFrame ray_frame(const Scene& scene);

/// Rays start this far (local units) from the surface, along the geometric normal towards the viewer. Float
/// coordinates of size 1 round to 6e-8; with Embree's robust mode 1e-5 keeps a surface from shadowing itself,
/// and moves contact shadows by a hundred-thousandth of the scene.
inline constexpr double kRayOffset = 1e-5;

/// What lies nearer to the light's plane than this (local units) hides nothing: whether a sheet in that plane
/// is in front of it is left to rounding. Rays end there, and edges are cut there.
inline constexpr double kLightOffset = 2e-6;
/// Where on its way to the light a ray ends that begins at this height in front of the light's plane (local
/// units).
inline float ray_end(float height) {
  return height > static_cast<float>(kLightOffset) ? 1.0f - static_cast<float>(kLightOffset) / height : 0.0f;
}

}  // namespace penumbra
