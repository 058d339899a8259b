// Moving the camera: a turntable about its target, as most programs for meshes have it.
#pragma once

#include "apps/viewer/handles/projection.h"
#include "penumbra/mesh/triangle_mesh.h"

namespace penumbra::viewer {

/// The side from which 1, 3 and 7 look.
enum class StandardView { kFront, kRight, kTop };

/// Turns the eye about the target: `yaw` about `world_up`, `pitch` upward, in radians. Stops short of looking
/// straight along `world_up`. The camera's up becomes `world_up`.
Camera rotated(const Camera& camera, const Vec3& world_up, double yaw, double pitch);
/// Moves eye and target so that what is at the target's depth follows the pointer by so many pixels.
Camera panned(const Camera& camera, int width, int height, double x_pixels, double y_pixels);
/// Scales the distances to `pivot` by `factor`: what is at the pivot stays where it is in the picture.
Camera zoomed(const Camera& camera, const Vec3& pivot, double factor);
/// Looks at the target from a side, at the same distance.
Camera seen_from(const Camera& camera, const Vec3& world_up, StandardView view);
/// The same direction, all of `bounds` in the picture. Bounds without extent change nothing.
Camera framed(const Camera& camera, const Bounds& bounds, int width, int height);
/// Turns to look at `target` from the same eye.
Camera centered(const Camera& camera, const Vec3& target);

}  // namespace penumbra::viewer
