// The camera with which a scene opens: where the file's own camera does not show the light, it is moved back.
#pragma once

#include "apps/viewer/handles/handled_light.h"
#include "penumbra/render/scene/scene.h"

namespace penumbra::viewer {

/// The camera itself where it shows all of the light and its handles. Else, looking the same way, the nearest
/// one from which these are seen: the casters, their shadow on the plane through the lowest point of the
/// scene, the camera's target and the light. Where the casters would be smaller than a sixth of the picture
/// the camera stays: the light is too far away.
Camera with_light_in_view(const Camera& camera, const Scene& scene, const HandledLight& light, int width,
                          int height);

}  // namespace penumbra::viewer
