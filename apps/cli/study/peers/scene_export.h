// study --peers: a case as JSON, for programs that read scenes by a script of ours.
#pragma once

#include <nlohmann/json.hpp>

#include "apps/cli/study/study_case.h"

namespace penumbra::apps {

/// {"width", "height",
///  "camera": {"eye", "forward", "right", "up", "fov_y_degrees", "near", "far"}, "light": {"kind": "disk" |
///  "distant", "center", "normal", "u", "v", "radius" | "angle_degrees", "distance"}, "objects": [{"casts",
///  "positions", "triangles"}]}
///
/// Directions are unit vectors; u × v is the light's normal turned around. A distant light's center is a
/// point of the scene, "distance" is from the light to the casters, or the scene's size. "near" and "far" are
/// planes with the scene between them. Positions are float32, triangles uint32, little-endian, in base64. The
/// light is a disk, near or distant.
nlohmann::json scene_export(const StudyCase& seen);

}  // namespace penumbra::apps
