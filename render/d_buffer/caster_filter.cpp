#include "render/d_buffer/caster_filter.h"

#include <tbb/parallel_for.h>

namespace penumbra::detail {

std::vector<std::uint32_t> triangles_before_hidden(const CasterTriangles& casters,
                                                   const std::vector<glm::vec4>& points,
                                                   const ReceiverGrid& receivers) {
  const std::vector<std::uint32_t>& indices = casters.indices;
  std::vector<char> needed(indices.size() / 3);
  const auto needs = [&](std::size_t triangle, bool only_fronts) {
    glm::dvec2 uv[3];
    UvBounds bounds;
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::vec4& p = points[indices[3 * triangle + k]];
      if (!(p.w > static_cast<float>(LightSpace::kNearWeight)))
        return true;  // cut there: may be seen anywhere
      uv[k] = glm::dvec2(glm::vec2(p) / p.w);
      bounds.add(uv[k]);
    }
    const glm::dvec2 one = uv[1] - uv[0], two = uv[2] - uv[0];
    if (only_fronts && one.x * two.y - one.y * two.x > 0.0) return false;
    return receivers.least_height(SupportKind::kUmbra, bounds) != ReceiverGrid::kNone;
  };
  for (const CasterRange& c : casters.ranges) {
    if (c.cannot_occlude) continue;
    tbb::parallel_for(c.first_index / 3, (c.first_index + c.index_count) / 3,
                      [&](std::uint32_t i) { needed[i] = needs(i, c.shows_only_fronts); });
  }
  std::vector<std::uint32_t> out;
  out.reserve(indices.size());
  for (std::size_t i = 0; i < needed.size(); ++i)
    if (needed[i]) out.insert(out.end(), &indices[3 * i], &indices[3 * i] + 3);
  return out;
}

}  // namespace penumbra::detail
