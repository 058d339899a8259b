#include "render/d_buffer/caster_filter.h"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "render/d_buffer/view/window_clip.h"

namespace penumbra::detail {
namespace {

enum Need : char { kNone, kWhole, kCut };

/// Of one triangle, by its corners.
Need need_of(const std::array<glm::vec4, 3>& corners, bool only_fronts, const ReceiverGrid& receivers) {
  const auto behind = std::ranges::count_if(
      corners, [](const glm::vec4& p) { return !(p.w > static_cast<float>(LightSpace::kNearWeight)); });
  if (behind > 0) return behind < 3 ? kCut : kNone;  // what crosses the light's plane may be seen anywhere
  glm::dvec2 uv[3];
  UvBounds bounds;
  for (std::size_t k = 0; k < 3; ++k) {
    uv[k] = glm::dvec2(glm::vec2(corners[k]) / corners[k].w);
    bounds.add(uv[k]);
  }
  const glm::dvec2 one = uv[1] - uv[0], two = uv[2] - uv[0];
  if (only_fronts && one.x * two.y - one.y * two.x > 0.0) return kNone;
  if (receivers.least_height(SupportKind::kUmbra, bounds) == ReceiverGrid::kNone) return kNone;
  const glm::dvec2 farthest = glm::max(glm::abs(bounds.low), glm::abs(bounds.high));
  return std::max(farthest.x, farthest.y) > kFarOutside ? kCut : kWhole;
}

/// What of a triangle is about the window.
void add_cut(const Vec3* world[3], const DBufferView& view, std::size_t points, ReadTriangles& out) {
  std::vector<glm::dvec4> polygon;
  for (int k = 0; k < 3; ++k) polygon.push_back(view.space.homogeneous(*world[k]));
  polygon = clipped_to_window(std::move(polygon), 2.0 * view.footprint.half_window);
  const auto first = static_cast<std::uint32_t>(points + out.more.size());
  for (const glm::dvec4& p : polygon) out.more.emplace_back(p);
  for (std::uint32_t k = 2; k < polygon.size(); ++k)
    out.indices.insert(out.indices.end(), {first, first + k - 1, first + k});
}

}  // namespace

ReadTriangles triangles_before_hidden(const CasterTriangles& casters, const DBufferView& view,
                                      const std::vector<glm::vec4>& points, const ReceiverGrid& receivers) {
  const std::vector<std::uint32_t>& indices = casters.indices;
  std::vector<Need> needs(indices.size() / 3, kNone);
  for (const CasterRange& c : casters.ranges) {
    if (c.cannot_occlude) continue;
    tbb::parallel_for(c.first_index / 3, (c.first_index + c.index_count) / 3, [&](std::uint32_t i) {
      const std::uint32_t* t = &indices[3 * std::size_t{i}];
      needs[i] = need_of({points[t[0]], points[t[1]], points[t[2]]}, c.shows_only_fronts, receivers);
    });
  }
  ReadTriangles out;
  out.indices.reserve(indices.size());
  for (std::size_t i = 0; i < needs.size(); ++i) {
    const std::uint32_t* t = &indices[3 * i];
    if (needs[i] == kWhole) out.indices.insert(out.indices.end(), t, t + 3);
    if (needs[i] != kCut) continue;
    const Vec3* world[3] = {&casters.points[t[0]], &casters.points[t[1]], &casters.points[t[2]]};
    add_cut(world, view, points.size(), out);
  }
  return out;
}

}  // namespace penumbra::detail
