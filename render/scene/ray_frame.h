// The frame of float stages: where rays have their digits.
//
// Everything is moved to the middle of what casts and scaled by a power of two, so that casters fill about [-1, 1] and
// float keeps its digits where shadows are decided. Lights and receivers may lie anywhere outside.
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

/// Takes the objects that cast into [-1, 1], or all objects where none casts. Lights do not matter.
RayFrame ray_frame(const Scene& scene);
/// Takes all objects into [-1, 1].
RayFrame frame_of_all_objects(const Scene& scene);

/// Rays start this far (local units) from the surface, along the geometric normal towards the viewer. Float
/// coordinates of size 1 round to 6e-8; with Embree's robust mode 1e-5 keeps a surface from shadowing itself,
/// and moves contact shadows by a hundred-thousandth of the casters.
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
