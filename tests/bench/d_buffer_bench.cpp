// The D-buffer against rays of equal error, and its cost by buffer size, faces and radius.
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <string>

#include "penumbra/mesh/shapes.h"
#include "render/d_buffer/d_buffer.h"
#include "render/gl/context.h"
#include "render/rays/camera_rays.h"
#include "tests/bench/bench_support.h"

namespace penumbra::bench {
namespace {

constexpr int kFrames = 7;
constexpr int kMostRays = 1024;        // more are not tried
constexpr double kLongFrame = 1000.0;  // ms; longer ones are repeated three times only

/// A frame of which all that depends on the light is found anew.
DBufferFrame fresh_frame(DBuffer& d_buffer, const DiskLight& light, const DBufferOptions& options = {}) {
  d_buffer.forget_light();
  return d_buffer.render(light, options);
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
    const ReferenceResult r =
        trace_reference(rays, shape_of(scene), surface.receivers(), truth.penumbra, options);
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

/// A scene ready to be drawn at 640×480.
struct Stand {
  explicit Stand(const Scene& of)
      : scene(of),
        rays(scene, 0),
        surface(make_surface_buffer(scene, rays, 640, 480)),
        context(gl::make_context(gl::Backend::kOsMesa)),
        d_buffer(*context, scene, rays) {
    d_buffer.set_surface(surface.receivers());
  }
  Scene scene;
  RayScene rays;
  SurfaceBuffer surface;
  std::unique_ptr<gl::Context> context;
  DBuffer d_buffer;
};

void time_scene(Record& record, const std::string& name) {
  Stand stand(bench_scene(name));
  const Truth truth(stand.scene, stand.rays, stand.surface, 1024);
  const double rmse = truth.rmse(stand.d_buffer.render(testing::light_of(stand.scene), {}).visibility);
  ReferenceOptions equal;
  equal.samples = rays_of_equal_error(stand.scene, stand.rays, stand.surface, truth, rmse);
  const std::vector<std::uint32_t> pixels = all_pixels(stand.surface);

  std::map<std::string, std::vector<double>> stages;
  std::vector<double> frames, rays, paired_frames;
  for (int i = 0; i < kFrames; ++i) {
    const DBufferFrame frame = fresh_frame(stand.d_buffer, testing::light_of(stand.scene));
    for (const StageTime& s : frame.stages) stages[s.name].push_back(s.milliseconds);
    frames.push_back(total_ms(frame.stages));
    if (!rays.empty() && rays.back() > kLongFrame && i >= 2) continue;
    const ReferenceResult r =
        trace_reference(stand.rays, shape_of(stand.scene), stand.surface.receivers(), pixels, equal);
    rays.push_back(r.milliseconds);
    paired_frames.push_back(frames.back());
  }
  record.set_renderer(stand.context->renderer());
  for (const auto& [stage, milliseconds] : stages) record.add(name + "/stage " + stage, "ms", milliseconds);
  record.add(name + "/dbuffer", "ms", frames);
  record.add(name + "/RMSE", "1", rmse);
  record.add(name + "/rays of equal error", equal.samples < kMostRays ? "a pixel" : "a pixel, at least",
             equal.samples);
  record.add(name + "/reference", "ms", rays);
  record.add(name + "/dbuffer : reference", "1", paired_ratios(paired_frames, rays));
  record.add(name + "/peak memory", "MiB", peak_memory_mib());
}

/// Frames in which all that depends on the light is found anew.
std::vector<double> frame_times(Stand& stand, const DBufferOptions& options = {}) {
  std::vector<double> times;
  for (int i = 0; i <= kFrames; ++i) {
    const double total =
        total_ms(fresh_frame(stand.d_buffer, testing::light_of(stand.scene), options).stages);
    if (i > 0) times.push_back(total);
  }
  return times;
}

void time_sizes(Record& record, const std::string& name) {
  Stand stand(bench_scene(name));
  for (int size : {256, 512, 1024, 2048}) {
    DBufferOptions options;
    options.size = size;
    record.add(name + "/size " + std::to_string(size), "ms", frame_times(stand, options));
  }
}

void time_faces(Record& record) {
  Scene scene = bench_scene("sphere-medium");
  for (int level = 2; level <= 7; ++level) {
    scene.objects[1].mesh = make_icosphere({0, 2.5, 0}, 1.0, level);
    Stand stand(scene);
    record.add("sphere/" + std::to_string(scene.objects[1].mesh.triangles().size()) + " faces", "ms",
               frame_times(stand));
  }
}

void time_radii(Record& record, const std::string& name) {
  Scene scene = bench_scene(name);
  for (double radius : {0.05, 0.1, 0.2, 0.4, 0.8, 1.6}) {
    testing::light_of(scene).radius = radius;
    Stand stand(scene);
    char text[16];
    std::snprintf(text, sizeof text, "%g", radius);
    record.add(name + "/radius " + text, "ms", frame_times(stand));
  }
}

}  // namespace

void bench_d_buffer(Record& record, const SceneNames& scenes) {
  for (const std::string& name : scenes) time_scene(record, name);
  time_sizes(record, "armadillo-medium");
  time_faces(record);
  time_radii(record, "knot1-medium");
}

}  // namespace penumbra::bench
