// Directions of vectors of any length.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "mesh/types.h"

namespace penumbra::detail {

/// v / |v|, divided by the largest component first, so that neither tiny nor huge vectors lose their
/// direction. The zero vector stays 0.
inline Vec3 unit_vector(const Vec3& v) {
  const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  return largest > 0.0 ? glm::normalize(v / largest) : Vec3(0.0);
}

}  // namespace penumbra::detail
