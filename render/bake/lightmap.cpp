#include "penumbra/render/bake/lightmap.h"

#include <algorithm>
#include <cmath>

#include "mesh/vectors.h"
#include "penumbra/mesh/error.h"
#include "render/bake/border_fit.h"
#include "render/bake/texture_coverage.h"

namespace penumbra {
namespace {

using detail::BorderSample;
using detail::TexelPiece;
using detail::TexelRange;

/// Accuracy: receivers along each side of a texel at a border, by which lookups are fitted.
constexpr int kBorderSide = 4;

void require_in_domain(const LightmapOptions& options) {
  const auto require = [](bool good, const char* name, const char* domain) {
    if (!good) throw UsageError(std::string(name) + " must be " + domain);
  };
  require(options.tile >= 8 && options.tile <= 1024, "tile", "8 to 1,024 texels");
  require(options.samples >= 1 && options.samples <= 64, "samples", "1 to 64");
  require(options.dilation >= 0 && options.dilation <= 64, "dilation", "0 to 64 texels");
}

/// Values of all tiles, put together.
struct Collected {
  std::vector<BorderSample> samples;
  std::vector<std::vector<float>> values;  ///< of samples, one list a channel
};

}  // namespace

struct LightmapBaker::State {
  State(const BakeSource& source_, const TextureAtlas& atlas_, const LightmapOptions& options_)
      : source(source_), atlas(atlas_), options(options_), coverage(atlas_, options_.tile) {}

  std::size_t texel(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(atlas.width) + static_cast<std::size_t>(x);
  }
  /// Receivers by which lookups are fitted, in an order that is always the same.
  void for_each_sample(std::size_t tile, const std::function<void(const TexelPiece&)>& visit) const {
    if (!options.fit_borders) return;
    coverage.for_each_piece(
        tile, kBorderSide, [this](int x, int y) { return coverage.is_at_border(x, y); }, visit);
  }
  std::size_t targets(std::size_t tile) const {
    std::size_t count = coverage.range_of(tile).size();
    for_each_sample(tile, [&count](const TexelPiece&) { ++count; });
    return count;
  }
  void add(const TexelPiece& piece, std::size_t target, BakeReceivers& out) const {
    const FaceUv& uv = atlas.uv[piece.object][piece.face];
    out.add(source.casters.objects()[piece.object].mesh, piece.object, piece.face,
            detail::barycentric_in(uv, piece.at), source.normal_of(piece.object, piece.face),
            static_cast<std::uint32_t>(target), piece.area);
  }
  void take(std::size_t tile, const std::vector<float>& values, Lightmap& map, Collected& collected) const;
  void fill_borders(const Collected& collected, Lightmap& map) const;

  const BakeSource& source;
  const TextureAtlas& atlas;
  LightmapOptions options;
  detail::TextureCoverage coverage;
};

LightmapBaker::LightmapBaker(const BakeSource& source, const TextureAtlas& atlas,
                             const LightmapOptions& options) {
  require_in_domain(options);
  state_ = std::make_unique<State>(source, atlas, options);
}
LightmapBaker::~LightmapBaker() = default;

std::size_t LightmapBaker::tiles() const {
  return state_->coverage.tiles();
}

std::size_t LightmapBaker::touched(std::size_t tile) const {
  const TexelRange range = state_->coverage.range_of(tile);
  std::size_t count = 0;
  for (int y = range.top; y < range.top + range.height; ++y)
    for (int x = range.left; x < range.left + range.width; ++x)
      count += state_->coverage.is_touched(x, y) ? 1 : 0;
  return count;
}

std::size_t LightmapBaker::values(std::size_t tile) const {
  return state_->source.channels() * state_->targets(tile);
}

std::vector<float> LightmapBaker::bake(std::size_t tile, const Progress& progress) const {
  const TexelRange range = state_->coverage.range_of(tile);
  BakeReceivers receivers;
  state_->coverage.for_each_piece(
      tile, state_->options.samples, [](int, int) { return true; },
      [&](const TexelPiece& piece) {
        state_->add(piece,
                    static_cast<std::size_t>((piece.y - range.top) * range.width + piece.x - range.left),
                    receivers);
      });
  std::size_t targets = range.size();
  state_->for_each_sample(tile, [&](const TexelPiece& piece) { state_->add(piece, targets++, receivers); });
  return bake_means(state_->source, receivers, targets, progress);
}

void LightmapBaker::State::take(std::size_t tile, const std::vector<float>& values, Lightmap& map,
                                Collected& collected) const {
  const std::size_t count = targets(tile), channels = source.channels();
  if (values.size() != channels * count)
    throw UsageError("tile " + std::to_string(tile) + " has " + std::to_string(values.size()) +
                     " values and should have " + std::to_string(channels * count) +
                     "; it is of another bake");
  const TexelRange range = coverage.range_of(tile);
  for (std::size_t c = 0; c < channels; ++c) {
    const float* const of_channel = &values[c * count];
    for (int y = 0; y < range.height; ++y)
      for (int x = 0; x < range.width; ++x)
        if (coverage.is_touched(range.left + x, range.top + y))
          map.channels[c][texel(range.left + x, range.top + y)] = of_channel[y * range.width + x];
    collected.values[c].insert(collected.values[c].end(), of_channel + range.size(), of_channel + count);
  }
  for_each_sample(tile, [&](const TexelPiece& piece) {
    collected.samples.push_back({piece.at, piece.area});
  });
}

void LightmapBaker::State::fill_borders(const Collected& collected, Lightmap& map) const {
  std::vector<char> has_value(map.coverage.size());
  for (std::size_t i = 0; i < has_value.size(); ++i) has_value[i] = map.coverage[i] > 0.0f;
  if (options.fit_borders) {
    detail::dilate(map.width, map.height, 1, has_value, map.channels);  // where the fit starts
    std::vector<std::uint32_t> unknown;
    std::vector<char> near = has_value;
    for (int y = 0; y < map.height; ++y)
      for (int x = 0; x < map.width; ++x) {
        if (coverage.is_full(x, y)) continue;
        bool touches = false;
        for (int j = -1; j <= 1; ++j)
          for (int i = -1; i <= 1; ++i) touches = touches || coverage.is_touched(x + i, y + j);
        if (!touches) continue;
        unknown.push_back(static_cast<std::uint32_t>(texel(x, y)));
        near[texel(x, y)] = 1;
      }
    has_value = std::move(near);
    const float most = source.quantity == BakeQuantity::kVisibility ? 1.0f : INFINITY;
    for (std::size_t c = 0; c < map.channels.size(); ++c) {
      detail::fit_borders(map.width, map.height, collected.samples, collected.values[c], unknown,
                          map.channels[c]);
      for (const std::uint32_t i : unknown) map.channels[c][i] = std::clamp(map.channels[c][i], 0.0f, most);
    }
  }
  detail::dilate(map.width, map.height, options.dilation, std::move(has_value), map.channels);
}

Lightmap LightmapBaker::finish(const std::function<std::vector<float>(std::size_t tile)>& values_of) const {
  const TextureAtlas& atlas = state_->atlas;
  const std::size_t channels = state_->source.channels();
  Lightmap map{.width = atlas.width, .height = atlas.height};
  map.coverage.resize(static_cast<std::size_t>(atlas.width) * static_cast<std::size_t>(atlas.height));
  for (int y = 0; y < atlas.height; ++y)
    for (int x = 0; x < atlas.width; ++x) map.coverage[state_->texel(x, y)] = state_->coverage.at(x, y);
  map.channels.assign(channels, std::vector<float>(map.coverage.size(), 0.0f));
  Collected collected{.samples = {}, .values = std::vector<std::vector<float>>(channels)};
  for (std::size_t t = 0; t < tiles(); ++t) state_->take(t, values_of(t), map, collected);
  state_->fill_borders(collected, map);
  return map;
}

double Lightmap::look_up(std::size_t channel, const glm::dvec2& at) const {
  const detail::BilinearTexels texels = detail::bilinear_texels(width, height, at);
  double sum = 0.0;
  for (std::size_t k = 0; k < 4; ++k) sum += texels.weight[k] * channels[channel][texels.index[k]];
  return sum;
}

Lightmap bake_lightmap(const BakeSource& source, const TextureAtlas& atlas, const LightmapOptions& options,
                       const Progress& progress) {
  const LightmapBaker baker(source, atlas, options);
  const auto count = static_cast<double>(baker.tiles());
  return baker.finish([&](std::size_t tile) {
    const auto done = static_cast<double>(tile);
    return baker.bake(tile, part_of(progress, done / count, (done + 1.0) / count));
  });
}

glm::dvec2 place_in_atlas(const TextureAtlas& atlas, const TriangleMesh& mesh, std::size_t object,
                          std::uint32_t face, const Vec3& point) {
  const auto p = mesh.positions();
  const auto& [a, b, c] = mesh.triangles()[face];
  const double scale =
      1.0 / std::max(detail::largest_component(p[b] - p[a]), detail::largest_component(p[c] - p[a]));
  const Vec3 u = (p[b] - p[a]) * scale, v = (p[c] - p[a]) * scale, w = (point - p[a]) * scale;
  const Vec3 n = glm::cross(u, v);
  const double at_b = std::clamp(glm::dot(glm::cross(w, v), n) / glm::dot(n, n), 0.0, 1.0);
  const double at_c = std::clamp(glm::dot(glm::cross(u, w), n) / glm::dot(n, n), 0.0, 1.0 - at_b);
  const FaceUv& uv = atlas.uv[object][face];
  return (1.0 - at_b - at_c) * uv[0] + at_b * uv[1] + at_c * uv[2];
}

}  // namespace penumbra
