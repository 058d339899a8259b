#include "render/silhouette/areas/aim_room.h"

#include <glm/geometric.hpp>

namespace penumbra::detail {

bool has_room(const glm::dvec2& point, double room, std::span<const Segment> segments, const DiskPart& part) {
  if (!(glm::length(point) + room < 1.0)) return false;
  if (part.is_cut() && !(height(part.horizon(), point) > room)) return false;
  const double room2 = room * room;
  bool any = false;
  for (const Segment& s : segments) {
    const glm::dvec2 a = s.a - point, b = s.b - point, along = s.b - s.a;
    any |= comes_near(glm::dot(a, a), glm::dot(b, b), glm::dot(along, along), glm::dot(a, along),
                      a.x * along.y - a.y * along.x, room2);
  }
  return !any;
}

}  // namespace penumbra::detail
