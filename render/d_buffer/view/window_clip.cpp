#include "render/d_buffer/view/window_clip.h"

#include <glm/geometric.hpp>

#include "render/d_buffer/view/light_space.h"

namespace penumbra::detail {
namespace {

/// Keeps what has a distance of at least 0.
template <class Distance>
std::vector<glm::dvec4> kept(const std::vector<glm::dvec4>& polygon, const Distance& distance) {
  std::vector<glm::dvec4> out;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec4 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double da = distance(a), db = distance(b);
    if (da >= 0.0) out.push_back(a);
    if ((da >= 0.0) != (db >= 0.0)) out.push_back(a + (b - a) * (da / (da - db)));
  }
  return out;
}

}  // namespace

std::vector<glm::dvec4> clipped_to_window(std::vector<glm::dvec4> polygon, double half) {
  polygon = kept(polygon, [](const glm::dvec4& p) { return p.w - LightSpace::kNearWeight; });
  const glm::dvec4 planes[] = {{1.0, 0.0, 0.0, half},
                               {-1.0, 0.0, 0.0, half},
                               {0.0, 1.0, 0.0, half},
                               {0.0, -1.0, 0.0, half},
                               {0.0, 0.0, 1.0, half}};
  for (const glm::dvec4& plane : planes)
    polygon = kept(polygon, [&](const glm::dvec4& p) { return glm::dot(plane, p); });
  return polygon;
}

}  // namespace penumbra::detail
