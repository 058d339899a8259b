// The frame of every method against its error. The silhouette method is taken as the truth: it has no noise.
#include <cmath>
#include <string>
#include <vector>

#include "penumbra/render/renderer.h"
#include "tests/bench/bench_support.h"

namespace penumbra::bench {
namespace {

constexpr int kFrames = 5;
constexpr double kNearlyNone = 1e-4;  // of the disk: above the silhouette method's own rounding

struct Row {
  std::string name, method;
  OptionValues options{};
};

std::vector<Row> rows() {
  const std::string d_buffer = "dbuffer", textures = "occlusion-textures", reference = "reference";
  const auto word = [](const char* text) { return OptionValue(std::string(text)); };
  return {
      {"silhouette", "silhouette"},
      {"dbuffer", d_buffer},
      {"dbuffer, two entries", d_buffer, {{"dbuffer-entries", 2u}}},
      {"dbuffer, no rays asked", d_buffer, {{"dbuffer-check", word("none")}}},
      {"dbuffer, furthest", d_buffer, {{"conflict", word("furthest")}, {"dbuffer-check", word("none")}}},
      {"dbuffer, the paper's",
       d_buffer,
       {{"dbuffer", word("distances")},
        {"visibility", word("smoothstep")},
        {"dbuffer-center", word("depth")},
        {"dbuffer-check", word("none")}}},
      {textures, textures},
      {"occlusion-textures, 8 slices", textures, {{"slices", 8u}}},
      {"occlusion-textures, all faces", textures, {{"slice-faces", word("all")}}},
      {"rays, 256 rays", "rays"},
      {"hard", "hard"},
      {"reference, 16 rays", reference, {{"samples", 16u}}},
      {"reference, 64 rays", reference, {{"samples", 64u}}},
      {"reference, 256 rays", reference},
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
  const std::vector<Row> all = rows();
  Renderer renderer(bench_scene(name));
  std::vector<Measured> measured(all.size());
  SurfaceBuffer surface;
  for (int i = 0; i <= kFrames; ++i)
    for (std::size_t k = 0; k < all.size(); ++k) {
      renderer.forget();
      RenderResult frame = renderer.render({.method = all[k].method, .options = all[k].options});
      if (all[k].method == "dbuffer") record.set_renderer(frame.lights.front().renderer);
      if (i == 0)  // warms up
        measured[k].visibility = frame.image.at("visibility"), surface = std::move(frame.surface);
      else
        measured[k].milliseconds.push_back(frame.frame_ms);
    }
  for (std::size_t k = 0; k < all.size(); ++k) {
    const std::string path = name + "/" + all[k].name;
    record.add(path + "/frame", "ms", measured[k].milliseconds);
    if (k == 0) continue;
    const Errors errors(renderer.scene(), surface, measured.front().visibility, measured[k].visibility);
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
