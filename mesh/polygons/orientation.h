// On which side of a line a point of the plane lies, decided exactly.
//
// Shewchuk, "Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric Predicates" (1997): a
// determinant in double with a bound of its error first, then the sum of its six products as an expansion.
// Exact unless a product underflows.
#pragma once

#include <glm/vec2.hpp>

namespace penumbra::detail {

using Vec2 = glm::dvec2;

/// The sign of the area of the triangle a, b, c: 1 where it runs counter-clockwise, 0 where the points lie on
/// one line.
int orientation(const Vec2& a, const Vec2& b, const Vec2& c);

/// Whether d certainly lies inside the circle through a, b and c, which run counter-clockwise. Close to the
/// circle the answer is no.
bool is_inside_circle(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d);

}  // namespace penumbra::detail
