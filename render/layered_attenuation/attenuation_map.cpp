#include "render/layered_attenuation/attenuation_map.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "render/light/light_samples.h"

namespace penumbra::detail {
namespace {

/// Speed. A view has at most so many times the texels a side of the center's view.
constexpr double kMostTexels = 4.0;

/// Where a window at the heights from lowest to top lies in a sheared view.
MapWindow sheared(const MapWindow& window, const glm::dvec2& shear, double lowest, double top) {
  MapWindow out;
  for (const double height : {lowest, top}) {
    out.add(window.low - shear * height);
    out.add(window.high - shear * height);
  }
  return out;
}

}  // namespace

AttenuationMap::AttenuationMap(const Scene& scene, const LightProjection& projection, const MapWindow& window,
                               double lowest, double top, bool disk, const AttenuationOptions& options,
                               tbb::task_arena& threads)
    : window_(window),
      size_(options.size),
      per_texel_(options.size / (window.high.x - window.low.x),
                 options.size / (window.high.y - window.low.y)),
      tolerance_(options.tolerance * std::max(1.0 / per_texel_.x, 1.0 / per_texel_.y)),
      texels_(static_cast<std::size_t>(options.size) * static_cast<std::size_t>(options.size)) {
  const StratumTable table(options.views);
  std::array<float, kSampleLanes> a, b;
  for (int first = 0; first < table.strata.count(); first += kSampleLanes) {
    place_samples(table, disk, sample_key(1, std::uint32_t{0}), first, a.data(), b.data());
    for (int k = 0; k < std::min(kSampleLanes, table.strata.count() - first); ++k) {
      const glm::dvec2 d(a[static_cast<std::size_t>(k)], b[static_cast<std::size_t>(k)]);
      const glm::dvec2 shear = projection.spread() * d;
      const MapWindow part = sheared(window, shear, lowest, top);
      // Texels as large as those of the center's view.
      const glm::dvec2 texels = (part.high - part.low) * per_texel_;
      const int size = static_cast<int>(
          std::ceil(std::clamp(std::max(texels.x, texels.y), 1.0, kMostTexels * options.size)));
      add_view(ShadowMap(scene, projection.seen_from(d), part, size, threads, Drawn::kAll), shear,
               static_cast<std::uint16_t>(++views_));
    }
  }
}

void AttenuationMap::add_view(const ShadowMap& view, const glm::dvec2& shear, std::uint16_t number) {
  for (int y = 0; y < view.size(); ++y)
    for (int x = 0; x < view.size(); ++x) {
      const float height = view.at(x, y);
      if (height == ShadowMap::kNothing) continue;
      const glm::dvec2 at =
          (view.center_of(x, y) + shear * static_cast<double>(height) - window_.low) * per_texel_;
      if (!(at.x >= 0.0 && at.y >= 0.0 && at.x < size_ && at.y < size_)) continue;
      add(static_cast<std::size_t>(at.y) * static_cast<std::size_t>(size_) + static_cast<std::size_t>(at.x),
          height, number);
    }
}

void AttenuationMap::add(std::size_t texel, float height, std::uint16_t number) {
  for (Layer& layer : texels_[texel]) {
    if (!(std::abs(layer.height - height) < tolerance_)) continue;
    layer.seen = static_cast<std::uint16_t>(layer.seen + (layer.last != number ? 1 : 0));
    layer.last = number;
    return;
  }
  texels_[texel].push_back({height, 1, number});
  ++layers_;
}

std::optional<double> AttenuationMap::share(const glm::dvec2& place, double height, double slope) const {
  const glm::dvec2 at = (place - window_.low) * per_texel_;
  if (!(at.x >= 0.0 && at.y >= 0.0 && at.x < size_ && at.y < size_)) return std::nullopt;
  const Layer* nearest = nullptr;
  double least = tolerance_ * (1.0 + slope);
  for (const Layer& layer : texels_[static_cast<std::size_t>(at.y) * static_cast<std::size_t>(size_) +
                                    static_cast<std::size_t>(at.x)])
    if (const double off = std::abs(layer.height - height); off < least) least = off, nearest = &layer;
  if (!nearest) return std::nullopt;
  return static_cast<double>(nearest->seen) / views_;
}

TexturePicture AttenuationMap::picture() const {
  TexturePicture out{.name = "attenuation of the first layer", .size = size_, .values = {}};
  for (const std::vector<Layer>& layers : texels_) {
    const auto first = std::ranges::max_element(layers, {}, &Layer::height);
    out.values.push_back(first == layers.end() ? std::uint8_t{0}
                                               : static_cast<std::uint8_t>(255 * first->seen / views_));
  }
  return out;
}

}  // namespace penumbra::detail
