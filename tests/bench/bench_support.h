// What the benchmarks share: medians, peak memory, references.
#pragma once

#include <sys/resource.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <string>
#include <vector>

#include "render/image/error_figures.h"
#include "render/rays/reference.h"
#include "render/receivers/surface_buffer.h"

namespace penumbra::bench {

inline double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values.empty() ? 0.0 : values[values.size() / 2];
}

/// Largest resident size of this process so far, MiB.
inline double peak_memory_mib() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

/// Two independent references of a view and its true penumbra.
struct Truth {
  std::vector<float> first, second;
  std::vector<std::uint32_t> receivers, penumbra;

  Truth(const Scene& scene, const RayScene& rays, const SurfaceBuffer& surface, int samples) {
    std::vector<std::uint32_t> pixels(surface.size());
    std::iota(pixels.begin(), pixels.end(), 0u);
    ReferenceOptions options;
    options.samples = samples;
    options.seed = 101;
    first = trace_reference(scene, rays, surface, pixels, options).visibility;
    options.seed = 102;
    second = trace_reference(scene, rays, surface, pixels, options).visibility;
    for (std::uint32_t p : pixels)
      if (surface.hit(p)) receivers.push_back(p);
    penumbra = true_penumbra(first, second, receivers);
  }
  double rmse(const std::vector<float>& visibility) const {
    return error_figures(visibility, first, second, penumbra).rmse;
  }
};

/// d_buffer_bench.cpp: the D-buffer against rays of equal error for scenes of data/scenes, and its cost as it
/// grows.
void bench_d_buffer(const std::vector<std::string>& scenes);

/// accuracy_bench.cpp: each method's frame and its error against the silhouette method, floor pixels and casters'
/// apart, for one scene of data/scenes.
void measure_accuracy(const std::string& name);

/// silhouette_bench.cpp: the silhouette method against rays, for one scene of data/scenes.
void time_silhouettes(const std::string& name);
/// The same file: 1,000 times the faces, and lights of 16 times the radius.
void time_silhouette_growth();

}  // namespace penumbra::bench
