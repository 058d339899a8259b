// Method soft-shadow-volumes: convex polygons in the plane of the light, and how much of the unit disk they
// hold.
#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "render/light/disk_area.h"

namespace penumbra::detail {

/// Convex, counter-clockwise.
using Polygon = std::vector<glm::dvec2>;

inline double cross(const glm::dvec2& a, const glm::dvec2& b) {
  return a.x * b.y - a.y * b.x;
}

/// The part of a polygon in a half-plane, into `out`; empty where there is none.
void clip(const Polygon& polygon, const Chord& half_plane, Polygon& out);
double area_of(const Polygon& polygon);
/// Of the part in the unit disk; exact up to rounding.
double area_in_disk(const Polygon& polygon);
/// Requires an area above 0.
glm::dvec2 centroid_of(const Polygon& polygon);
/// From a point to the nearest one of a segment.
double distance_to(const glm::dvec2& p, const glm::dvec2& a, const glm::dvec2& b);
/// The half-plane on the left of a → b; requires a ≠ b.
Chord left_of(const glm::dvec2& a, const glm::dvec2& b);

/// The area of the unit disk behind the segment a b as seen from its center: between the segment, the rays
/// through its ends, and the rim. Positive where the center lies on the left of a → b, else negative. Exact
/// up to rounding.
double area_behind(const glm::dvec2& a, const glm::dvec2& b);

}  // namespace penumbra::detail
