// The light's disk as a receiver sees it, as a small picture to look at: what hides it, and where the
// receiver's horizon cuts it. For looking only; how much is visible is said by the methods and by rays.
#pragma once

#include "apps/viewer/pictures/picture_texture.h"
#include "penumbra/render/scene/scene.h"

namespace penumbra::viewer {

/// `size` pixels a side, the disk filling most of it; looked at from `x` with unit normal `n`. Light where
/// nothing is in the way, dark where a caster is, outlined, brown below the horizon; faint outside of the
/// disk. Empty where x is behind the light or the radius is 0. Cost O(faces + covered pixels).
Pixels disk_seen_from(const Scene& scene, const DiskLight& light, const Vec3& x, const Vec3& n, int size);

}  // namespace penumbra::viewer
