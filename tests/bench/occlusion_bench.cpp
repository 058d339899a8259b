// Occlusion textures: prefilters; frames by the light's radius and by the number of slices.
#include <chrono>
#include <cmath>
#include <cstdio>
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

void time_prefilters(Record& record) {
  for (const int size : {256, 512}) {
    const auto texels = round_mask(size);
    std::vector<double> mip, boxes, table;
    for (int i = 0; i < kRounds; ++i) {
      mip.push_back(prefilter_ms<detail::MipPyramid>(texels, size));
      boxes.push_back(prefilter_ms<detail::NBuffer>(texels, size));
      table.push_back(prefilter_ms<detail::SummedArea>(texels, size));
    }
    const std::string path = "prefilter/" + std::to_string(size) + "/";
    record.add(path + "mipmap", "ms", mip);
    record.add(path + "nbuffer", "ms", boxes);
    record.add(path + "sat", "ms", table);
    record.add(path + "nbuffer : sat", "1", paired_ratios(boxes, table));
  }
}

double frame_ms(Renderer& renderer, std::uint64_t slices) {
  renderer.forget();
  return renderer.render({.method = "occlusion-textures", .options = {{"slices", slices}}}).frame_ms;
}

/// One frame of each in turn: what else the machine does hits all alike.
void time_radii(Record& record, const std::string& name) {
  const std::vector<double> radii{0.2, 0.4, 0.8, 1.6, 3.2};
  std::vector<std::unique_ptr<Renderer>> renderers;
  for (const double radius : radii) {
    Scene scene = bench_scene(name);
    testing::light_of(scene).radius = radius;
    renderers.push_back(std::make_unique<Renderer>(std::move(scene)));
    frame_ms(*renderers.back(), 16);
  }
  std::vector<std::vector<double>> frames(radii.size());
  for (int round = 0; round < kRounds; ++round)
    for (std::size_t i = 0; i < radii.size(); ++i) frames[i].push_back(frame_ms(*renderers[i], 16));
  for (std::size_t i = 0; i < radii.size(); ++i) {
    char radius[16];
    std::snprintf(radius, sizeof radius, "%g", radii[i]);
    const std::string path = name + "/radius " + radius;
    record.add(path + "/frame", "ms", frames[i]);
    record.add(path + "/times the first", "1", paired_ratios(frames[i], frames[0]));
  }
}

void time_slices(Record& record, const std::string& name) {
  Renderer renderer(bench_scene(name));
  const std::vector<int> counts{4, 8, 12, 16};
  std::vector<std::vector<double>> frames(counts.size());
  for (int round = 0; round <= kRounds; ++round)
    for (std::size_t i = 0; i < counts.size(); ++i) {
      const double ms = frame_ms(renderer, static_cast<std::uint64_t>(counts[i]));
      if (round > 0) frames[i].push_back(ms);
    }
  for (std::size_t i = 0; i < counts.size(); ++i)
    record.add(name + "/slices " + std::to_string(counts[i]) + "/frame", "ms", frames[i]);
}

}  // namespace

void bench_occlusion_textures(Record& record, const SceneNames&) {
  time_prefilters(record);
  for (const char* name : {"cube-medium", "foliage-medium"}) time_radii(record, name);
  time_slices(record, "foliage-medium");
}

}  // namespace penumbra::bench
