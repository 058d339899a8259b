// Whether two triangles have more in common than shared corners and a shared side.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "penumbra/mesh/types.h"

namespace penumbra::detail {

using Corners = std::array<Vec3, 3>;

/// False where the two closed triangles surely have nothing in common but corners at equal positions, and, if
/// two corners are, the side between them. Exact for triangles with area; one without may be said to meet
/// what it does not. A triangle meets itself. Cost O(1).
bool do_meet(const Corners& a, const Corners& b);

/// +1 where the segment x → y leaves through the front of the triangle, from which its corners run
/// counter-clockwise, -1 where it enters there, 0 where it misses; nothing where it touches a side or a
/// corner, or an end lies in the plane.
std::optional<int> crossing(const Vec3& x, const Vec3& y, const Corners& t);

}  // namespace penumbra::detail
