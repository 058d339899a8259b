#include "render/d_buffer/caster_filter.h"

#include <tbb/parallel_for.h>

#include <glm/geometric.hpp>

namespace penumbra::detail {

bool shows_only_fronts(const CasterRange& caster, const DBufferView& view) {
  if (!caster.closed) return false;
  for (int corner = 0; corner < 8; ++corner) {
    const Bounds& b = caster.bounds;
    const glm::vec3 p(corner & 1 ? b.high.x : b.low.x, corner & 2 ? b.high.y : b.low.y,
                      corner & 4 ? b.high.z : b.low.z);
    if ((view.axes * p + view.offset).z <= static_cast<float>(kNearDepth)) return false;
  }
  return true;
}

std::vector<std::uint32_t> triangles_before_hidden(const CasterTriangles& casters, const DBufferView& view,
                                                   const ReceiverGrid& receivers) {
  const std::vector<std::uint32_t>& indices = casters.indices;
  std::vector<glm::vec3> in_light_frame(casters.points.size());
  tbb::parallel_for(std::size_t{0}, in_light_frame.size(),
                    [&](std::size_t i) { in_light_frame[i] = view.axes * casters.points[i] + view.offset; });
  std::vector<char> needed(indices.size() / 3);
  const auto needs = [&](std::size_t triangle, bool only_fronts) {
    const std::uint32_t* corners = &indices[3 * triangle];
    const glm::vec3 p[3] = {in_light_frame[corners[0]], in_light_frame[corners[1]],
                            in_light_frame[corners[2]]};
    if (only_fronts && glm::dot(glm::cross(p[1] - p[0], p[2] - p[0]), p[0]) > 0.0f) return false;
    UvBounds bounds;
    for (const glm::vec3& q : p) {
      if (q.z <= static_cast<float>(kNearDepth)) return true;  // cut there: may be seen anywhere
      bounds.add(glm::dvec2(glm::vec2(q) / q.z));
    }
    return receivers.least_weight(SupportKind::kUmbra, bounds) != ReceiverGrid::kNone;
  };
  for (const CasterRange& c : casters.ranges) {
    if (c.cannot_occlude) continue;
    const bool only_fronts = shows_only_fronts(c, view);
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
