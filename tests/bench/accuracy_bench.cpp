// Every method's time against its error, the silhouette method as the truth: no noise, no long references.
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "penumbra/render/renderer.h"
#include "tests/bench/bench_support.h"

namespace penumbra::bench {
namespace {

constexpr int kFrames = 3;
constexpr double kNearlyNone = 1e-4;  // of the disk: the silhouette method's own rounding and more

struct Row {
  const char* name;
  std::function<void(RenderOptions&)> choose;
};

std::vector<Row> rows() {
  const auto d_buffer = [](auto change) {
    return [change](RenderOptions& o) { o.method = Method::kDBuffer, change(o.d_buffer); };
  };
  const auto rays = [](int samples) {
    return [samples](RenderOptions& o) { o.method = Method::kReference, o.reference.samples = samples; };
  };
  return {
      {"dbuffer", d_buffer([](DBufferOptions&) {})},
      {"dbuffer, two entries", d_buffer([](DBufferOptions& o) { o.entries = 2; })},
      {"dbuffer, no rays asked", d_buffer([](DBufferOptions& o) { o.check = EntryCheck::kNone; })},
      {"dbuffer, the paper's", d_buffer([](DBufferOptions& o) {
         o.contents = DBufferContents::kDistances, o.curve = VisibilityCurve::kSmoothstep;
         o.center = CenterTest::kDepth, o.check = EntryCheck::kNone;
       })},
      {"occlusion-textures", [](RenderOptions& o) { o.method = Method::kOcclusionTextures; }},
      {"reference, 16 rays", rays(16)},
      {"reference, 64 rays", rays(64)},
      {"reference, 256 rays", rays(256)},
  };
}

struct Error {
  double squares = 0.0, largest = 0.0;
  std::size_t pixels = 0;
  void add(double e) {
    squares += e * e;
    largest = std::max(largest, std::abs(e));
    ++pixels;
  }
  double rmse() const { return pixels ? std::sqrt(squares / static_cast<double>(pixels)) : 0.0; }
};

struct Measured {
  std::vector<float> visibility;
  double milliseconds;
};

/// The median of some frames after one that warms up.
Measured measure(Renderer& renderer, const RenderOptions& options, RenderResult& last) {
  std::vector<double> times;
  for (int i = 0; i <= kFrames; ++i) {
    last = renderer.render_frame(options);
    if (i > 0) times.push_back(last.frame_ms);
  }
  return {last.image.at("visibility"), median(times)};
}

}  // namespace

void measure_accuracy(const std::string& name) {
  const Scene scene = load_scene(std::string(PENUMBRA_DATA) + "/scenes/" + name + ".json").scene;
  RenderOptions options;
  options.method = Method::kSilhouette;
  Renderer renderer(scene, options);
  RenderResult last;
  const Measured truth = measure(renderer, options, last);
  const SurfaceBuffer surface = last.surface;
  std::printf("%s\n  %-24s %29s %8.1f ms\n", name.c_str(), "silhouette", "the truth here",
              truth.milliseconds);
  for (const Row& row : rows()) {
    RenderOptions chosen;
    row.choose(chosen);
    const Measured m = measure(renderer, chosen, last);
    Error floor, casters;
    for (std::size_t i = 0; i < surface.size(); ++i) {
      const double v = truth.visibility[i];
      if (!surface.hit(i) || v < kNearlyNone || v > 1.0 - kNearlyNone) continue;
      const bool casts = scene.objects[static_cast<std::size_t>(surface.object[i])].casts;
      (surface.object[i] == 0 || !casts ? floor : casters).add(m.visibility[i] - v);
    }
    std::printf("  %-24s RMSE %.5f ; %.5f (max %.2f) %8.1f ms\n", row.name, floor.rmse(), casters.rmse(),
                std::max(floor.largest, casters.largest), m.milliseconds);
    std::fflush(stdout);
  }
}

}  // namespace penumbra::bench
