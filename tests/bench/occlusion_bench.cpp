#include "tests/bench/occlusion_bench.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <memory>
#include <string>

#include "penumbra/render/renderer.h"
#include "render/occlusion_textures/mip_pyramid.h"
#include "render/occlusion_textures/n_buffer.h"
#include "render/occlusion_textures/summed_area.h"
#include "tests/bench/bench_support.h"

namespace penumbra::bench {
namespace {

constexpr int kRounds = 15;

/// A round caster of a third of the texture.
std::vector<std::uint8_t> round_mask(int size) {
  std::vector<std::uint8_t> texels;
  for (int j = 0; j < size; ++j)
    for (int i = 0; i < size; ++i)
      texels.push_back(std::hypot(i - 0.5 * size, j - 0.5 * size) < size / 3.0 ? 255 : 0);
  return texels;
}

/// Milliseconds for 16 slices, on one core.
template <class Filter>
double prefilter_ms(const std::vector<std::uint8_t>& texels, int size) {
  const auto start = std::chrono::steady_clock::now();
  std::size_t bytes = 0;
  for (int slice = 0; slice < 16; ++slice) bytes += Filter(texels, size).bytes();
  const auto passed = std::chrono::steady_clock::now() - start;
  return bytes > 0 ? std::chrono::duration<double, std::milli>(passed).count() : 0.0;
}

void time_prefilters() {
  for (const int size : {256, 512}) {
    const auto texels = round_mask(size);
    std::vector<double> mip, boxes, table;
    for (int i = 0; i < kRounds; ++i) {
      mip.push_back(prefilter_ms<detail::MipPyramid>(texels, size));
      boxes.push_back(prefilter_ms<detail::NBuffer>(texels, size));
      table.push_back(prefilter_ms<detail::SummedArea>(texels, size));
    }
    const double m = median(mip), n = median(boxes), s = median(table);
    std::printf(
        "prefilter of 16 slices of %d², one core: mipmap %.1f ms, N-buffer %.1f ms, summed area %.1f ms;"
        " N-buffer / summed area %.1f, mipmap / summed area %.2f\n",
        size, m, n, s, n / s, m / s);
  }
}

double least(const std::vector<double>& values) {
  return *std::min_element(values.begin(), values.end());
}

Scene bench_scene(const std::string& name) {
  return load_scene(std::string(PENUMBRA_DATA) + "/scenes/" + name + ".json").scene;
}

RenderOptions occlusion_options(int slices) {
  RenderOptions options;
  options.method = Method::kOcclusionTextures;
  options.occlusion.slices = slices;
  return options;
}

double visibility_ms(const RenderResult& frame) {
  for (const StageTime& s : frame.stages)
    if (s.name == "visibility") return s.milliseconds;
  return 0.0;
}

/// One frame of each in turn: what else the machine does hits all alike.
void time_radii(const std::string& name) {
  const std::vector<double> radii{0.2, 0.4, 0.8, 1.6, 3.2};
  std::vector<Scene> scenes(radii.size(), bench_scene(name));
  std::vector<std::unique_ptr<Renderer>> renderers;
  const RenderOptions options = occlusion_options(16);
  for (std::size_t i = 0; i < radii.size(); ++i) {
    scenes[i].light.radius = radii[i];
    renderers.push_back(std::make_unique<Renderer>(scenes[i], options));
    renderers.back()->render_frame(options);
  }
  std::vector<std::vector<double>> frames(radii.size()), lookups(radii.size()), ratios(radii.size()),
      work(radii.size());
  for (int round = 0; round < kRounds; ++round)
    for (std::size_t i = 0; i < radii.size(); ++i) {
      const std::clock_t start = std::clock();
      const RenderResult frame = renderers[i]->render_frame(options);
      work[i].push_back(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
      frames[i].push_back(frame.frame_ms);
      lookups[i].push_back(visibility_ms(frame));
      ratios[i].push_back(frame.frame_ms / frames[0].back());
    }
  std::printf(
      "%s, radius → ms a frame (of it lookups; median of paired ratios to the first; ratio of least "
      "processor "
      "times):",
      name.c_str());
  for (std::size_t i = 0; i < radii.size(); ++i)
    std::printf("  %.1f → %.0f (%.0f; %.2f; %.2f)", radii[i], median(frames[i]), median(lookups[i]),
                median(ratios[i]), least(work[i]) / least(work[0]));
  std::printf("\n");
}

void time_slices(const std::string& name) {
  const Scene scene = bench_scene(name);
  Renderer renderer(scene, occlusion_options(16));
  const std::vector<int> counts{4, 8, 12, 16};
  std::vector<std::vector<double>> frames(counts.size());
  for (int round = 0; round <= kRounds; ++round)
    for (std::size_t i = 0; i < counts.size(); ++i) {
      const double ms = renderer.render_frame(occlusion_options(counts[i])).frame_ms;
      if (round > 0) frames[i].push_back(ms);
    }
  std::printf("%s, slices → ms a frame:", name.c_str());
  for (std::size_t i = 0; i < counts.size(); ++i) std::printf("  %d → %.0f", counts[i], median(frames[i]));
  std::printf("\n");
}

}  // namespace

void bench_occlusion_textures() {
  time_prefilters();
  for (const char* name : {"cube-medium", "foliage-medium"}) time_radii(name);
  time_slices("foliage-medium");
  std::printf("\n");
}

}  // namespace penumbra::bench
