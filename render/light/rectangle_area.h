// What the receiver's tangent plane leaves of a rectangular light: its area and its form factor.
//
// In the light's frame: the rectangle |x| ≤ half.x, |y| ≤ half.y in z = 0, which shines towards +z. The part
// above the plane n·(p - x) = 0 is a polygon of at most five corners; the integrals are exact for it.
#pragma once

#include <glm/vec2.hpp>

#include "penumbra/mesh/types.h"

namespace penumbra::detail {

/// Lambert's integral of n·(p × q)/|p × q| times the angle between p and q, over one straight edge p → q of a
/// polygon that is seen from the origin; minus half of it. Summed over a polygon that turns left about +z it
/// is ∫ cos θ cos θ' / d². 0 where the edge is seen end on.
double edge_irradiance(const Vec3& p, const Vec3& q, const Vec3& n);

/// ∫ cos θ cos θ' / d² over the part above the horizon, of receiver x with unit normal n. 0 for x.z ≤ 0.
double rectangle_irradiance_factor(const Vec3& x, const Vec3& n, const glm::dvec2& half);

/// The area fraction above the horizon. 0 for x.z ≤ 0.
double rectangle_above_horizon(const Vec3& x, const Vec3& n, const glm::dvec2& half);

}  // namespace penumbra::detail
