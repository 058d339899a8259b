// What a light shines at, so that it can keep shining at it while it is moved.
#pragma once

#include <optional>

#include "penumbra/render/scene/scene.h"

namespace penumbra::viewer {

/// The first point of the scene on the light's axis; where it meets none, the point of the axis nearest to
/// the middle of the casters; none where that is behind the light. Cost O(triangles).
std::optional<Vec3> lit_point(const Scene& scene, const DiskLight& light);

}  // namespace penumbra::viewer
