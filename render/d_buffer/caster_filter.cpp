#include "render/d_buffer/caster_filter.h"

#include <tbb/parallel_for.h>

#include <glm/geometric.hpp>

namespace penumbra::detail {

bool shows_only_fronts(const CasterRange& caster, const glm::mat3& axes, const glm::vec3& offset) {
  if (!caster.closed) return false;
  for (int corner = 0; corner < 8; ++corner) {
    const Bounds& b = caster.bounds;
    const glm::vec3 p(corner & 1 ? b.high.x : b.low.x, corner & 2 ? b.high.y : b.low.y,
                      corner & 4 ? b.high.z : b.low.z);
    if ((axes * p + offset).z <= static_cast<float>(kNearDepth)) return false;
  }
  return true;
}

std::vector<std::uint32_t> triangles_before_hidden(std::span<const glm::vec3> points,
                                                   std::span<const std::uint32_t> indices,
                                                   std::span<const CasterRange> casters,
                                                   const glm::mat3& axes, const glm::vec3& offset,
                                                   const ReceiverGrid& receivers) {
  std::vector<glm::vec3> local(points.size());
  tbb::parallel_for(std::size_t{0}, points.size(),
                    [&](std::size_t i) { local[i] = axes * points[i] + offset; });
  std::vector<char> needed(indices.size() / 3);
  const auto needs = [&](std::size_t triangle, bool only_fronts) {
    const glm::vec3 p[3] = {local[indices[3 * triangle]], local[indices[3 * triangle + 1]],
                            local[indices[3 * triangle + 2]]};
    if (only_fronts && glm::dot(glm::cross(p[1] - p[0], p[2] - p[0]), p[0]) > 0.0f) return false;
    UvBounds bounds;
    for (const glm::vec3& q : p) {
      if (q.z <= static_cast<float>(kNearDepth)) return true;  // cut there: may be seen anywhere
      bounds.add(glm::dvec2(glm::vec2(q) / q.z));
    }
    return receivers.least_weight(SupportKind::kUmbra, bounds) != ReceiverGrid::kNone;
  };
  for (const CasterRange& c : casters) {
    if (c.idle) continue;
    const bool only_fronts = shows_only_fronts(c, axes, offset);
    tbb::parallel_for(c.first_index / 3, (c.first_index + c.index_count) / 3,
                      [&](std::uint32_t i) { needed[i] = needs(i, only_fronts); });
  }
  std::vector<std::uint32_t> out;
  out.reserve(indices.size());
  for (std::size_t i = 0; i < needed.size(); ++i)
    if (needed[i]) out.insert(out.end(), &indices[3 * i], &indices[3 * i] + 3);
  return out;
}

}  // namespace penumbra::detail
