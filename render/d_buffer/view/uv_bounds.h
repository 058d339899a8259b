// A rectangle of lines of sight from the light's center.
#pragma once

#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <limits>

namespace penumbra::detail {

/// In (u, v) of light space (render/d_buffer/view/light_space.h).
struct UvBounds {
  glm::dvec2 low{std::numeric_limits<double>::infinity()}, high{-std::numeric_limits<double>::infinity()};
  void add(const glm::dvec2& uv) {
    low = glm::min(low, uv);
    high = glm::max(high, uv);
  }
  void add(const UvBounds& other) {
    low = glm::min(low, other.low);
    high = glm::max(high, other.high);
  }
  bool empty() const { return !(low.x <= high.x && low.y <= high.y); }
  glm::dvec2 middle() const { return 0.5 * low + 0.5 * high; }
  /// The longer side.
  double extent() const { return glm::max(high.x - low.x, high.y - low.y); }
};

/// What is common to both, which may be empty.
inline UvBounds common(const UvBounds& one, const UvBounds& two) {
  return {glm::max(one.low, two.low), glm::min(one.high, two.high)};
}

}  // namespace penumbra::detail
