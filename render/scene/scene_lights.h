// The lights of a scene file: {"shape": "disk" | "rectangle" | "distant", ...} and their names.
#pragma once

#include <vector>

#include "penumbra/render/light/light.h"
#include "render/scene/scene_node.h"

namespace penumbra::detail {

/// The list behind the key "lights". Of several lights those without a name are called light0, light1, ... by
/// their place in the list. Throws SceneError: no light, a name twice, a name of other characters than
/// letters, digits, '-' and '_', values outside their range.
std::vector<Light> read_lights(const SceneNode& root);

/// Whether all are letters, digits, '-' and '_', at least one and at most 200: channels of an EXR have names
/// of up to 255.
bool is_light_name(const std::string& name);

/// Whether two vectors of any length are so nearly parallel (sine below 1e-9) that they span no plane; also
/// where one of them is 0 or no number.
bool are_parallel(const Vec3& a, const Vec3& b);

}  // namespace penumbra::detail
