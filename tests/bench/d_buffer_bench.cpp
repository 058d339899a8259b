// The D-buffer against rays of equal error, and its cost by buffer size, faces and radius.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>

#include "penumbra/mesh/shapes.h"
#include "penumbra/render/renderer.h"
#include "tests/bench/bench_support.h"

namespace penumbra::bench {
namespace {

constexpr int kFrames = 7;
constexpr int kMostRays = 1024;  // more are not tried

/// A frame of which all that depends on the light is found anew.
DBufferFrame fresh_frame(DBuffer& d_buffer, const DiskLight& light, const DBufferOptions& options = {}) {
  d_buffer.forget_light();
  return d_buffer.render(light, options);
}

double total_ms(const DBufferFrame& frame) {
  double total = 0.0;
  for (const StageTime& s : frame.stages) total += s.milliseconds;
  return total;
}

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
    frame = fresh_frame(d_buffer, scene.light);
    for (const StageTime& s : frame.stages) {
      if (stages[s.name].empty()) order.push_back(s.name);
      stages[s.name].push_back(s.milliseconds);
    }
    totals.push_back(total_ms(frame));
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
      const double total = total_ms(fresh_frame(d_buffer, scene.light, options));
      if (i > 0) totals.push_back(total);
    }
    std::printf("  %d → %.0f", size, median(totals));
  }
  std::printf("\n");
}

/// Median over frames of all that depends on the light, at 640×480.
double frame_ms(const Scene& scene) {
  const RayScene rays(scene, 0);
  const SurfaceBuffer surface = make_surface_buffer(scene, rays, 640, 480);
  const auto context = gl::make_context(gl::Backend::kOsMesa);
  DBuffer d_buffer(*context, scene, rays);
  d_buffer.set_surface(surface);
  std::vector<double> totals;
  for (int i = 0; i < kFrames; ++i) {
    const double total = total_ms(fresh_frame(d_buffer, scene.light));
    if (i > 0) totals.push_back(total);
  }
  return median(totals);
}

void time_faces() {
  std::printf("sphere over a floor, faces → milliseconds a frame:");
  Scene scene = load_scene(std::string(PENUMBRA_DATA) + "/scenes/sphere-medium.json").scene;
  for (int level = 2; level <= 7; ++level) {
    scene.objects[1].mesh = make_icosphere({0, 2.5, 0}, 1.0, level);
    std::printf("  %zu → %.0f", scene.objects[1].mesh.triangles().size(), frame_ms(scene));
    std::fflush(stdout);
  }
  std::printf("\n");
}

void time_radii(const std::string& name) {
  std::printf("%s, light's radius → milliseconds a frame:", name.c_str());
  Scene scene = load_scene(std::string(PENUMBRA_DATA) + "/scenes/" + name + ".json").scene;
  for (double radius : {0.05, 0.1, 0.2, 0.4, 0.8, 1.6}) {
    scene.light.radius = radius;
    std::printf("  %g → %.0f", radius, frame_ms(scene));
    std::fflush(stdout);
  }
  std::printf("\n");
}

}  // namespace

void bench_d_buffer(const std::vector<std::string>& scenes) {
  for (const std::string& name : scenes) time_scene(name);
  time_sizes("armadillo-medium");
  time_faces();
  time_radii("knot1-medium");
}

}  // namespace penumbra::bench
