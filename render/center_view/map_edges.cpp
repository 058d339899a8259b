#include "render/center_view/map_edges.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace penumbra::detail {

MapEdge::Nearest MapEdge::nearest(const glm::dvec2& place) const {
  const glm::dvec2 way = b - a;
  const double length2 = glm::dot(way, way);
  const double t = length2 > 0.0 ? std::clamp(glm::dot(place - a, way) / length2, 0.0, 1.0) : 0.0;
  return {glm::distance(place, a + t * way), height_a + t * (height_b - height_a)};
}

std::vector<MapEdge> map_edges(const VolumePolygons& polygons, const LightProjection& projection) {
  std::vector<MapEdge> out;
  for (const VolumeSide& side : polygons.sides) {
    Vec3 a = projection.local(side.a), b = projection.local(side.b);
    const double at_a = projection.weight(a) - kLeastWeight, at_b = projection.weight(b) - kLeastWeight;
    if (at_a < 0.0 && at_b < 0.0) continue;
    if (at_a < 0.0) a += (at_a / (at_a - at_b)) * (b - a);
    if (at_b < 0.0) b += (at_b / (at_b - at_a)) * (a - b);
    const double weight_a = std::max(kLeastWeight, projection.weight(a)),
                 weight_b = std::max(kLeastWeight, projection.weight(b));
    out.push_back(
        {projection.place(a) / weight_a, projection.place(b) / weight_b, -a.z / weight_a, -b.z / weight_b});
  }
  return out;
}

}  // namespace penumbra::detail
