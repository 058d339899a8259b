// What accuracy costs in time: `./run bench`. Medians of interleaved frames, everything finished, one
// process.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>

#include "render/render.h"
#include "tests/bench/bench_support.h"
#include "tests/bench/occlusion_bench.h"

namespace penumbra::bench {
namespace {

constexpr int kFrames = 7;
constexpr int kMostRays = 1024;  // more are not tried

/// Rays per pixel at which stratified sampling has the given error, by log-log interpolation between measured
/// counts.
int rays_of_equal_error(const Scene& scene, const RayScene& rays, const SurfaceBuffer& surface,
                        const Truth& truth, double rmse) {
  double last_n = 0.0, last_error = 0.0;
  for (int n : {1, 4, 16, 64, 256, kMostRays}) {
    ReferenceOptions options;
    options.samples = n;
    options.seed = 7;
    std::vector<float> all(surface.size(), 1.0f);
    const ReferenceResult r = trace_reference(scene, rays, surface, truth.penumbra, options);
    for (std::size_t i = 0; i < truth.penumbra.size(); ++i) all[truth.penumbra[i]] = r.visibility[i];
    const double error = truth.rmse(all);
    if (error <= rmse) {
      if (last_n == 0.0) return n;
      const double share = std::log(last_error / rmse) / std::log(last_error / error);
      return std::max(1, static_cast<int>(std::lround(last_n * std::pow(n / last_n, share))));
    }
    last_n = n;
    last_error = error;
  }
  return kMostRays;
}

void time_scene(const std::string& name) {
  const Scene scene = load_scene(std::string(PENUMBRA_DATA) + "/scenes/" + name + ".json").scene;
  RayScene rays(scene, 0);
  const SurfaceBuffer surface = make_surface_buffer(scene, rays, 640, 480);
  const Truth truth(scene, rays, surface, 1024);
  const auto context = gl::make_context(gl::Backend::kOsMesa);
  DBuffer d_buffer(*context, scene, rays);
  d_buffer.set_surface(surface);
  DBufferFrame frame = d_buffer.render(scene.light, {});
  const double rmse = truth.rmse(frame.visibility);
  ReferenceOptions equal;
  equal.samples = rays_of_equal_error(scene, rays, surface, truth, rmse);

  std::map<std::string, std::vector<double>> stages;
  std::vector<double> totals, ray_times, single_times;
  std::vector<std::string> order;
  std::vector<std::uint32_t> pixels(surface.size());
  std::iota(pixels.begin(), pixels.end(), 0u);
  std::size_t traced = 0;
  for (int i = 0; i < kFrames; ++i) {
    frame = d_buffer.render(scene.light, {});
    double total = 0.0;
    for (const StageTime& s : frame.stages) {
      if (stages[s.name].empty()) order.push_back(s.name);
      stages[s.name].push_back(s.milliseconds);
      total += s.milliseconds;
    }
    totals.push_back(total);
    if (!ray_times.empty() && ray_times.back() > 1000.0 && i >= 2) continue;  // long runs need fewer
    equal.packets = true;
    const ReferenceResult r = trace_reference(scene, rays, surface, pixels, equal);
    ray_times.push_back(r.milliseconds);
    traced = r.rays;
    equal.packets = false;
    single_times.push_back(trace_reference(scene, rays, surface, pixels, equal).milliseconds);
  }
  std::printf("%s, 640x480, %zu pixels in true penumbra\n  dbuffer ", name.c_str(), truth.penumbra.size());
  for (const std::string& s : order) std::printf(" %s %.1f", s.c_str(), median(stages[s]));
  const double ours = median(totals), theirs = median(ray_times);
  std::printf("\n  dbuffer    %8.1f ms a frame (%.1f frames a second), RMSE %.4f over true penumbra\n", ours,
              1e3 / ours, rmse);
  std::printf("  reference  %8.1f ms with %d rays a pixel at %s RMSE (%.0f Mrays/s; %.0f one by one)\n",
              theirs, equal.samples, equal.samples < kMostRays ? "the same" : "no smaller",
              static_cast<double>(traced) / (1e3 * theirs),
              static_cast<double>(traced) / (1e3 * median(single_times)));
  std::printf("  the D-buffer %s: %.2f times the rays' time\n", ours < theirs ? "wins" : "loses",
              ours / theirs);
  std::printf(
      "  Embree's hierarchy (not in the above) %.1f ms; peak memory of the process so far %.0f MiB\n\n",
      rays.build_ms(), peak_memory_mib());
  std::fflush(stdout);
}

/// The whole-target cost of one scene against the D-buffer's size.
void time_sizes(const std::string& name) {
  const Scene scene = load_scene(std::string(PENUMBRA_DATA) + "/scenes/" + name + ".json").scene;
  RayScene rays(scene, 0);
  const SurfaceBuffer surface = make_surface_buffer(scene, rays, 640, 480);
  const auto context = gl::make_context(gl::Backend::kOsMesa);
  DBuffer d_buffer(*context, scene, rays);
  d_buffer.set_surface(surface);
  std::printf("%s, D-buffer size → milliseconds a frame:", name.c_str());
  for (int size : {256, 512, 1024, 2048}) {
    DBufferOptions options;
    options.size = size;
    std::vector<double> totals;
    for (int i = 0; i < kFrames; ++i) {
      double total = 0.0;
      for (const StageTime& s : d_buffer.render(scene.light, options).stages) total += s.milliseconds;
      if (i > 0) totals.push_back(total);
    }
    std::printf("  %d → %.0f", size, median(totals));
  }
  std::printf("\n");
}

}  // namespace
}  // namespace penumbra::bench

int main(int argc, char** argv) {
  // `./run bench occlusion` runs only that part.
  const std::string only = argc > 1 ? argv[1] : "";
  if (only.empty() || only == "occlusion") penumbra::bench::bench_occlusion_textures();
  if (only == "occlusion") return 0;
  for (const char* name : {"cube-medium", "bunny-medium", "knot1-medium", "armadillo-medium"})
    penumbra::bench::time_scene(name);
  penumbra::bench::time_sizes("armadillo-medium");
  return 0;
}
