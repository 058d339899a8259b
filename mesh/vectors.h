// Small vector helpers that survive very large and very small lengths.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "penumbra/mesh/types.h"

namespace penumbra::detail {

inline double largest_component(const Vec3& v) {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

/// v divided by its largest component: squares of the result neither overflow nor vanish. The zero vector
/// stays.
inline Vec3 scaled_to_one(const Vec3& v) {
  const double largest = largest_component(v);
  return largest > 0.0 ? Vec3(v.x / largest, v.y / largest, v.z / largest) : v;
}

/// Unit vector along v, at any scale. The zero vector stays.
inline Vec3 unit(const Vec3& v) {
  return largest_component(v) > 0.0 ? glm::normalize(scaled_to_one(v)) : v;
}

/// A unit vector perpendicular to the unit vector w: by the axis that w leans to least.
inline Vec3 unit_perpendicular(const Vec3& w) {
  const Vec3 a(std::abs(w.x), std::abs(w.y), std::abs(w.z));
  const Vec3 axis = a.x <= a.y && a.x <= a.z ? Vec3(1, 0, 0) : (a.y <= a.z ? Vec3(0, 1, 0) : Vec3(0, 0, 1));
  return glm::normalize(glm::cross(axis, w));
}

}  // namespace penumbra::detail
