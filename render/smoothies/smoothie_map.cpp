#include "render/smoothies/smoothie_map.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>

namespace penumbra::detail {
namespace {

std::uint64_t encoded(float alpha, float height) {
  return std::uint64_t{std::bit_cast<std::uint32_t>(alpha)} << 32 | std::bit_cast<std::uint32_t>(height);
}

}  // namespace

SmoothieMap::Fin SmoothieMap::decoded(std::uint64_t code) {
  return {std::bit_cast<float>(static_cast<std::uint32_t>(code >> 32)),
          std::bit_cast<float>(static_cast<std::uint32_t>(code))};
}

SmoothieMap::SmoothieMap(const ShadowMap& casters, const std::vector<MapEdge>& edges, double width,
                         tbb::task_arena& threads)
    : casters_(casters), fins_(std::make_unique<std::uint64_t[]>(casters.texels())) {
  std::fill_n(fins_.get(), casters.texels(), encoded(1.0f, 0.0f));
  threads.execute([&] {
    tbb::parallel_for(std::size_t{0}, edges.size(), [&](std::size_t i) { draw(edges[i], width); });
  });
}

void SmoothieMap::draw(const MapEdge& edge, double width) {
  const glm::dvec2 low(std::min(edge.a.x, edge.b.x) - width, std::min(edge.a.y, edge.b.y) - width),
      high(std::max(edge.a.x, edge.b.x) + width, std::max(edge.a.y, edge.b.y) + width);
  const TexelRange range = casters_.texels_in(low, high);
  for (int y = range.first_y; y < range.end_y; ++y)
    for (int x = range.first_x; x < range.end_x; ++x) {
      const MapEdge::Nearest near = edge.nearest(casters_.center_of(x, y));
      if (!(near.distance < width)) continue;
      const std::uint64_t code =
          encoded(static_cast<float>(near.distance / width), static_cast<float>(near.height));
      const std::atomic_ref<std::uint64_t> fin(
          fins_[static_cast<std::size_t>(y) * static_cast<std::size_t>(casters_.size()) +
                static_cast<std::size_t>(x)]);
      std::uint64_t was = fin.load(std::memory_order_relaxed);
      while (code < was && !fin.compare_exchange_weak(was, code, std::memory_order_relaxed)) {
      }
    }
}

SmoothieMap::Fin SmoothieMap::at(const glm::dvec2& place) const {
  const glm::dvec2 p = casters_.texels_to(place);
  const int size = casters_.size();
  if (!(p.x >= 0.0 && p.y >= 0.0 && p.x < size && p.y < size)) return {1.0f, 0.0f};
  return decoded(
      fins_[static_cast<std::size_t>(p.y) * static_cast<std::size_t>(size) + static_cast<std::size_t>(p.x)]);
}

TexturePicture SmoothieMap::picture() const {
  TexturePicture out{.name = "smoothies, dark near silhouettes", .size = casters_.size(), .values = {}};
  for (std::size_t i = 0; i < casters_.texels(); ++i)
    out.values.push_back(static_cast<std::uint8_t>(255.0f * decoded(fins_[i]).alpha));
  return out;
}

}  // namespace penumbra::detail
