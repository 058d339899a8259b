// The frame of every method against its error. The silhouette method is taken as the truth: it has no noise.
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "penumbra/render/renderer.h"
#include "tests/bench/bench_support.h"

namespace penumbra::bench {
namespace {

constexpr int kFrames = 5;
constexpr double kNearlyNone = 1e-4;  // of the disk: above the silhouette method's own rounding

struct Row {
  const char* name;
  std::function<void(RenderOptions&)> choose;
};

std::vector<Row> rows() {
  const auto d_buffer = [](auto change) {
    return [change](RenderOptions& o) { o.method = Method::kDBuffer, change(o.d_buffer); };
  };
  const auto textures = [](auto change) {
    return [change](RenderOptions& o) { o.method = Method::kOcclusionTextures, change(o.occlusion); };
  };
  const auto rays = [](int samples) {
    return [samples](RenderOptions& o) { o.method = Method::kReference, o.reference.samples = samples; };
  };
  return {
      {"silhouette", [](RenderOptions& o) { o.method = Method::kSilhouette; }},
      {"dbuffer", d_buffer([](DBufferOptions&) {})},
      {"dbuffer, two entries", d_buffer([](DBufferOptions& o) { o.entries = 2; })},
      {"dbuffer, no rays asked", d_buffer([](DBufferOptions& o) { o.check = EntryCheck::kNone; })},
      {"dbuffer, furthest",
       d_buffer([](DBufferOptions& o) { o.conflict = Conflict::kFurthest, o.check = EntryCheck::kNone; })},
      {"dbuffer, the paper's", d_buffer([](DBufferOptions& o) {
         o.contents = DBufferContents::kDistances, o.curve = VisibilityCurve::kSmoothstep;
         o.center = CenterTest::kDepth, o.check = EntryCheck::kNone;
       })},
      {"occlusion-textures", textures([](OcclusionOptions&) {})},
      {"occlusion-textures, 8 slices", textures([](OcclusionOptions& o) { o.slices = 8; })},
      {"occlusion-textures, all faces", textures([](OcclusionOptions& o) { o.faces = SliceFaces::kAll; })},
      {"rays, 256 rays", [](RenderOptions& o) { o.method = Method::kRays; }},
      {"hard", [](RenderOptions& o) { o.method = Method::kHard; }},
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
  std::vector<double> milliseconds;
};

/// Over pixels that the truth calls penumbra: those of what does not cast, and those of casters.
struct Errors {
  Error floor, casters;
  Errors(const Scene& scene, const SurfaceBuffer& surface, const std::vector<float>& truth,
         const std::vector<float>& visibility) {
    for (std::size_t i = 0; i < surface.size(); ++i) {
      const double v = truth[i];
      if (!surface.hit(i) || v < kNearlyNone || v > 1.0 - kNearlyNone) continue;
      const bool casts = scene.objects[static_cast<std::size_t>(surface.object[i])].casts;
      (surface.object[i] == 0 || !casts ? floor : casters).add(visibility[i] - v);
    }
  }
};

void measure(Record& record, const std::string& name) {
  const Scene scene = bench_scene(name);
  const std::vector<Row> all = rows();
  std::vector<RenderOptions> options(all.size());
  for (std::size_t k = 0; k < all.size(); ++k) all[k].choose(options[k]);
  Renderer renderer(scene, options.front());
  std::vector<Measured> measured(all.size());
  SurfaceBuffer surface;
  for (int i = 0; i <= kFrames; ++i)
    for (std::size_t k = 0; k < all.size(); ++k) {
      RenderResult frame = renderer.render_frame(options[k]);
      if (options[k].method == Method::kDBuffer) record.set_renderer(frame.stats.at("renderer"));
      if (i == 0)  // warms up
        measured[k].visibility = frame.image.at("visibility"), surface = std::move(frame.surface);
      else
        measured[k].milliseconds.push_back(frame.frame_ms);
    }
  for (std::size_t k = 0; k < all.size(); ++k) {
    const std::string path = name + "/" + all[k].name;
    record.add(path + "/frame", "ms", measured[k].milliseconds);
    if (k == 0) continue;
    const Errors errors(scene, surface, measured.front().visibility, measured[k].visibility);
    record.add(path + "/RMSE floor", "1", errors.floor.rmse());
    record.add(path + "/RMSE casters", "1", errors.casters.rmse());
    record.add(path + "/largest", "1", std::max(errors.floor.largest, errors.casters.largest));
  }
}

}  // namespace

void bench_accuracy(Record& record, const SceneNames& scenes) {
  for (const std::string& name : scenes) measure(record, name);
}

}  // namespace penumbra::bench
