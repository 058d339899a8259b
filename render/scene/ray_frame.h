// The frame of float stages: where rays have their digits.
//
// Everything is moved to the middle of what casts and scaled by a power of two, so that casters fill about
// [-1, 1] and float keeps its digits where shadows are decided. Lights and receivers may lie anywhere
// outside.
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

/// Takes the box into [-1, 1]; the world as it is where that is empty.
RayFrame frame_around(const Bounds& bounds);
/// Takes the objects that cast into [-1, 1], or all objects where none casts. Lights do not matter.
RayFrame ray_frame(const Scene& scene);
/// Takes all objects into [-1, 1].
RayFrame frame_of_all_objects(const Scene& scene);

}  // namespace penumbra
