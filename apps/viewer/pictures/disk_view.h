// The light's disk as a receiver sees it, as a small picture to look at: what hides it, and where the
// receiver's horizon cuts it. For looking only; how much is visible is said by the methods and by rays.
#pragma once

#include <cstdint>

#include "apps/viewer/pictures/picture_texture.h"
#include "penumbra/render/scene/scene.h"
#include "render/light/area_light.h"

namespace penumbra::viewer {

/// A point of a surface, from which the light is looked at.
struct Viewpoint {
  Vec3 position, normal;
  /// The face on which it lies: it hides nothing. -1: on none.
  std::int32_t object = -1;
  std::uint32_t face = 0;
};

/// `size` pixels a side, the disk, near or distant, filling most of it. Light where nothing is in the way,
/// dark where a caster is, outlined, brown below the horizon; faint outside of the disk. Empty where the
/// point is behind the light or the radius is 0. Cost O(faces + covered pixels).
Pixels disk_seen_from(const Scene& scene, const AreaLight& light, const Viewpoint& from, int size);

}  // namespace penumbra::viewer
