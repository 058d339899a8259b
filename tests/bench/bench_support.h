// What the benchmarks share: scenes, peak memory, references. Each part measures one subject and adds its
// figures to a record.
#pragma once

#include <sys/resource.h>

#include <cstdint>
#include <filesystem>
#include <numeric>
#include <string>
#include <vector>

#include "penumbra/mesh/stage_clock.h"
#include "penumbra/render/image/error_figures.h"
#include "penumbra/render/receivers/surface_buffer.h"
#include "penumbra/render/scene/scene.h"
#include "render/rays/ray_scene.h"
#include "render/rays/reference.h"
#include "tests/bench/record.h"
#include "tests/render/visibility_support.h"

namespace penumbra::bench {

using SceneNames = std::vector<std::string>;

/// A scene of data/scenes, or else of data/regressions/scenes, that has one light, by its name without folder
/// and extension.
inline Scene bench_scene(const std::string& name) {
  const std::filesystem::path data(PENUMBRA_DATA), file = data / "scenes" / (name + ".json");
  return load_scene(std::filesystem::exists(file) ? file : data / "regressions/scenes" / (name + ".json"))
      .scene;
}

/// The shape of the scene's only light.
inline const LightShape& shape_of(const Scene& scene) {
  return scene.lights.at(0).shape;
}

inline double total_ms(const std::vector<StageTime>& stages) {
  double sum = 0.0;
  for (const StageTime& s : stages) sum += s.milliseconds;
  return sum;
}

inline double median(std::vector<double> values) {
  return spread_of(std::move(values)).median;
}

/// Quotients of values that were measured one after the other.
inline std::vector<double> paired_ratios(const std::vector<double>& over, const std::vector<double>& under) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < over.size() && i < under.size(); ++i) ratios.push_back(over[i] / under[i]);
  return ratios;
}

/// Largest resident size of this process so far, MiB.
inline double peak_memory_mib() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

inline std::vector<std::uint32_t> all_pixels(const SurfaceBuffer& surface) {
  std::vector<std::uint32_t> pixels(surface.size());
  std::iota(pixels.begin(), pixels.end(), 0u);
  return pixels;
}

/// Two independent references of a view and its true penumbra.
struct Truth {
  std::vector<float> first, second;
  std::vector<std::uint32_t> receivers, penumbra;

  Truth(const Scene& scene, const RayScene& rays, const SurfaceBuffer& surface, int samples) {
    const std::vector<std::uint32_t> pixels = all_pixels(surface);
    ReferenceOptions options;
    options.samples = samples;
    options.seed = 101;
    first = trace_reference(rays, shape_of(scene), surface.receivers(), pixels, options).visibility;
    options.seed = 102;
    second = trace_reference(rays, shape_of(scene), surface.receivers(), pixels, options).visibility;
    for (std::uint32_t p : pixels)
      if (surface.hit(p)) receivers.push_back(p);
    penumbra = true_penumbra(first, second, receivers);
  }
  double rmse(const std::vector<float>& visibility) const {
    return error_figures(visibility, first, second, penumbra).rmse;
  }
};

/// accuracy_bench.cpp: the frame of every method and its error against the silhouette method, on the floor
/// and on the casters.
void bench_accuracy(Record& record, const SceneNames& scenes);

/// judge_bench.cpp: methods against rays in double without offset (tests/oracle).
void bench_judge(Record& record, const SceneNames& scenes);

/// d_buffer_bench.cpp: the D-buffer against rays of the same error; its cost by its size, by faces and by the
/// light's radius.
void bench_d_buffer(Record& record, const SceneNames& scenes);

/// d_buffer_judge_bench.cpp: the D-buffer's options against rays in double without offset.
void bench_d_buffer_judge(Record& record, const SceneNames& scenes);

/// d_buffer_check_bench.cpp: the D-buffer with and without its rays against the silhouette method, at three
/// sizes. No scenes: all.
void bench_d_buffer_check(Record& record, const SceneNames& scenes);

/// silhouette_bench.cpp: the silhouette method against rays, visibility alone; what is certified.
void bench_silhouette(Record& record, const SceneNames& scenes);
/// The same file: 1,000 times the faces, and lights of 16 times the radius.
void bench_growth(Record& record, const SceneNames&);

/// frames_bench.cpp: a moving light before a camera that stays, made anew against kept from frame to frame.
void bench_frames(Record& record, const SceneNames& scenes);

/// pops_bench.cpp: the change from frame to frame of a moving light against the change that rays find.
void bench_pops(Record& record, const SceneNames& scenes);

/// occlusion_bench.cpp: prefilters; frames by the light's radius and by the number of slices.
void bench_occlusion_textures(Record& record, const SceneNames&);

/// sun_bench.cpp: a year of hourly suns on 10,000 receivers of a city block, against 64 rays a receiver.
void bench_sun(Record& record, const SceneNames&);

/// terrain_bench.cpp: heightfields; instead of scenes the numbers of posts along a side.
void bench_terrain(Record& record, const SceneNames& sides);

/// price_bench.cpp: what exact classification costs, and what plain arithmetic gets wrong.
void bench_price(Record& record, const SceneNames&);

/// solids_bench.cpp: time and triangles of umbra and penumbra solids.
void bench_solids(Record& record, const SceneNames& scenes);
/// The same file: their surfaces by CGAL, a million points each by rays in double; minutes a scene.
void bench_solids_judge(Record& record, const SceneNames& scenes);
/// Fields of 256³ points.
void bench_fields(Record& record, const SceneNames& scenes);

/// volumes_bench.cpp: cells, triangles and time of penumbra and umbra volumes.
void bench_volumes(Record& record, const SceneNames& scenes);

}  // namespace penumbra::bench
