#include "render/penumbra_maps/penumbra_map.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>

namespace penumbra::detail {

PenumbraMap::PenumbraMap(const ShadowMap& surfaces, const std::vector<MapEdge>& edges, double radius,
                         double lowest, tbb::task_arena& threads)
    : surfaces_(surfaces), shares_(std::make_unique<std::uint32_t[]>(surfaces.texels())) {
  std::fill_n(shares_.get(), surfaces.texels(), std::bit_cast<std::uint32_t>(1.0f));
  threads.execute([&] {
    tbb::parallel_for(std::size_t{0}, edges.size(), [&](std::size_t i) { draw(edges[i], radius, lowest); });
  });
}

void PenumbraMap::draw(const MapEdge& edge, double radius, double lowest) {
  const double reach = radius * (edge.top() - lowest);
  if (!(reach > 0.0)) return;
  const glm::dvec2 low(std::min(edge.a.x, edge.b.x) - reach, std::min(edge.a.y, edge.b.y) - reach),
      high(std::max(edge.a.x, edge.b.x) + reach, std::max(edge.a.y, edge.b.y) + reach);
  const TexelRange range = surfaces_.texels_in(low, high);
  for (int y = range.first_y; y < range.end_y; ++y)
    for (int x = range.first_x; x < range.end_x; ++x) {
      const float height = surfaces_.at(x, y);
      if (height == ShadowMap::kNothing) continue;
      const MapEdge::Nearest near = edge.nearest(surfaces_.center_of(x, y));
      const double width = radius * (near.height - double{height});
      if (!(near.distance < width)) continue;
      const std::uint32_t bits = std::bit_cast<std::uint32_t>(static_cast<float>(near.distance / width));
      const std::atomic_ref<std::uint32_t> share(
          shares_[static_cast<std::size_t>(y) * static_cast<std::size_t>(surfaces_.size()) +
                  static_cast<std::size_t>(x)]);
      std::uint32_t was = share.load(std::memory_order_relaxed);
      while (bits < was && !share.compare_exchange_weak(was, bits, std::memory_order_relaxed)) {
      }
    }
}

/// 0 weight where no surface is.
PenumbraMap::Weighed PenumbraMap::at(int x, int y, float weight) const {
  const int last = surfaces_.size() - 1, column = std::clamp(x, 0, last), row = std::clamp(y, 0, last);
  if (surfaces_.at(column, row) == ShadowMap::kNothing) return {0.0f, 0.0f};
  const std::size_t texel = static_cast<std::size_t>(row) * static_cast<std::size_t>(surfaces_.size()) +
                            static_cast<std::size_t>(column);
  return {weight * std::bit_cast<float>(shares_[texel]), weight};
}

float PenumbraMap::share(const glm::dvec2& place) const {
  const glm::dvec2 p = surfaces_.texels_to(place) - 0.5;
  if (!(p.x >= -0.5 && p.y >= -0.5 && p.x <= surfaces_.size() && p.y <= surfaces_.size())) return 1.0f;
  const double column = std::floor(p.x), row = std::floor(p.y);
  const auto s = static_cast<float>(p.x - column), t = static_cast<float>(p.y - row);
  const int x = static_cast<int>(column), y = static_cast<int>(row);
  Weighed sum{0.0f, 0.0f};
  for (const Weighed& part : {at(x, y, (1.0f - s) * (1.0f - t)), at(x + 1, y, s * (1.0f - t)),
                              at(x, y + 1, (1.0f - s) * t), at(x + 1, y + 1, s * t)}) {
    sum.share += part.share;
    sum.weight += part.weight;
  }
  return sum.weight > 0.0f ? sum.share / sum.weight : 1.0f;
}

TexturePicture PenumbraMap::picture() const {
  TexturePicture out{.name = "penumbra map, dark near silhouettes", .size = surfaces_.size(), .values = {}};
  for (std::size_t i = 0; i < surfaces_.texels(); ++i)
    out.values.push_back(static_cast<std::uint8_t>(255.0f * std::bit_cast<float>(shares_[i])));
  return out;
}

}  // namespace penumbra::detail
