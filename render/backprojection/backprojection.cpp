#include "render/backprojection/backprojection.h"

#include <atomic>
#include <bit>
#include <deque>
#include <glm/geometric.hpp>

#include "render/rays/each_receiver.h"
#include "render/receivers/receiver_middle.h"

namespace penumbra {
namespace {

using namespace detail;

/// The samples below a receiver's horizon.
void hide_below_horizon(const AreaLight& light, const Receivers& receivers, std::size_t i,
                        const LightMasks& masks, std::vector<MaskWord>& mask) {
  const Vec3 center = light.from_receiver(receivers.points[i]), &normal = receivers.normals[i];
  for (std::size_t k = 0; k < masks.count(); ++k) {
    const glm::dvec2& s = masks.samples()[k];
    const Vec3 way = center + s.x * light.half.x * light.axes.u + s.y * light.half.y * light.axes.v;
    if (!(glm::dot(normal, way) > 0.0)) mask[k / 64] |= MaskWord{1} << (k % 64);
  }
}

}  // namespace

MethodResult backprojected_visibility(const Scene& scene, const AreaLight& light, const Receivers& receivers,
                                      const BackprojectionOptions& options, bool keep_textures,
                                      tbb::task_arena& threads, const Progress& progress) {
  MethodResult out;
  out.visibility.assign(receivers.size(), 1.0f);
  StageClock clock;
  const ReceiverMiddle middle = receiver_middle(receivers);
  const LightProjection projection(light, middle.middle, middle.least_depth());
  const MapWindow window = looked_at(reach_of_casters(scene, projection), projection, receivers);
  const LightMasks masks(light.disk, options.samples, 1);
  std::deque<ShadowMap> layers;
  std::deque<PatchTree> trees;
  for (int k = 0; k < options.layers && !window.empty(); ++k) {
    layers.emplace_back(scene, projection, window, options.map_size, threads, Drawn::kCasters,
                        layers.empty() ? nullptr : &layers.back());
    trees.emplace_back(layers.back(), projection.spread(), masks, options.patches);
    if (keep_textures) out.textures.push_back(layers.back().picture());
  }
  clock.finish("shadow_maps");
  std::atomic<std::size_t> patches{0};
  for_each_receiver(threads, receivers.size(), progress, [&](std::size_t i) {
    if (!receivers.is_present(i)) return;
    const double above = above_horizon(light, receivers, i);
    std::vector<MaskWord> mask(masks.words(), 0);
    if (above > 0.0 && above < 1.0) hide_below_horizon(light, receivers, i, masks, mask);
    std::size_t looked = 0;
    if (const auto at = above > 0.0 ? to_map(projection, receivers, i) : std::nullopt)
      for (const PatchTree& tree : trees) looked += tree.hide(*at, mask);
    std::size_t hidden = 0;
    for (const MaskWord word : mask) hidden += static_cast<std::size_t>(std::popcount(word));
    out.visibility[i] =
        above > 0.0 ? 1.0f - static_cast<float>(hidden) / static_cast<float>(masks.count()) : 0.0f;
    patches.fetch_add(looked, std::memory_order_relaxed);
  });
  clock.finish("visibility");
  out.stages = clock.stages();
  out.counts = {{"patches", patches.load()},
                {"map_texels", layers.empty() ? std::size_t{0} : layers.size() * layers.front().texels()}};
  return out;
}

}  // namespace penumbra
