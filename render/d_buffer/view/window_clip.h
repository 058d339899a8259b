// What of a polygon is about the window: OpenGL clips in float, which costs a polygon that is a million times
// as large all of its digits.
#pragma once

#include <glm/vec4.hpp>
#include <vector>

namespace penumbra::detail {

/// Speed: polygons whose corners are within so many units of the window's middle are left to OpenGL.
inline constexpr double kFarOutside = 16.0;

/// The part with |u| and |v| at most `half` and h at least -half, in front of the light. Corners are (u, v,
/// h, 1) · weight of a space with a window. It may have no corners. Cost O(corners).
std::vector<glm::dvec4> clipped_to_window(std::vector<glm::dvec4> polygon, double half);

}  // namespace penumbra::detail
