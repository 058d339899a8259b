// A camera that sees all of some points, as near as it can be.
#pragma once

#include <span>

#include "penumbra/render/scene/camera.h"

namespace penumbra::detail {

/// Of a picture's shape: half its width and half its height at unit distance.
struct Frustum {
  double half_width, half_height;
};

/// Where a camera that looks along `forward` stands so that the frustum holds all points, and none of its two
/// pairs of sides has room on one side only: closed form, by the points farthest out on each side. Exact for
/// any perspective. `up` is not parallel to `forward`. No point is nearer than half the depth of all points.
/// The target lies at the depth of the middle of the points. Cost O(points).
Camera camera_that_sees(std::span<const Vec3> points, const Vec3& forward, const Vec3& up,
                        const Frustum& frustum);

}  // namespace penumbra::detail
