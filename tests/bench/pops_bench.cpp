// Whether a frame pops: a light moves for a hundred frames, and the change from each to the next is held against the change
// that rays find.
#include <cmath>
#include <string>
#include <vector>

#include "penumbra/render/renderer.h"
#include "tests/bench/bench_support.h"
#include "tests/bench/moving_light.h"

namespace penumbra::bench {
namespace {

constexpr int kFrames = 100;
constexpr int kWidth = 160, kHeight = 120;

RenderOptions options_of(const std::string& method) {
  RenderOptions options{.method = method, .width = kWidth, .height = kHeight};
  if (method == "reference") options.options["samples"] = std::uint64_t{256};
  return options;
}

/// What a plan chose, in words.
std::string choices_of(const MethodFrame& frame) {
  std::string text;
  for (const Decision& each : frame.decisions) text += each.about + "=" + each.choice + " ";
  return text;
}

/// Changes from one frame to the next, RMS over the pixels at which the light is partly seen in either by rays.
struct Changes {
  std::vector<double> own, of_rays, apart, largest;
  int plans = 0;

  void add(const std::vector<float>& before, const std::vector<float>& after,
           const std::vector<float>& rays_before, const std::vector<float>& rays_after) {
    double sum_own = 0.0, sum_rays = 0.0, sum_apart = 0.0, most = 0.0, count = 0.0;
    const auto is_partly = [](float v) { return v > 0.0f && v < 1.0f; };
    for (std::size_t i = 0; i < before.size(); ++i) {
      if (!is_partly(rays_before[i]) && !is_partly(rays_after[i])) continue;
      const double change = double{after[i]} - double{before[i]};
      const double true_change = double{rays_after[i]} - double{rays_before[i]};
      sum_own += change * change;
      sum_rays += true_change * true_change;
      sum_apart += (change - true_change) * (change - true_change);
      most = std::max(most, std::abs(change - true_change));
      ++count;
    }
    if (count == 0.0) return;
    own.push_back(std::sqrt(sum_own / count));
    of_rays.push_back(std::sqrt(sum_rays / count));
    apart.push_back(std::sqrt(sum_apart / count));
    largest.push_back(most);
  }
};

void measure(Record& record, const std::string& name) {
  const Scene scene = bench_scene(name);
  const std::vector<std::string> methods{"reference", "silhouette", "auto"};
  Renderer renderer(scene);
  std::vector<std::vector<float>> before(methods.size());
  std::vector<Changes> changes(methods.size());
  std::vector<std::string> plans(methods.size());
  for (int k = 0; k <= kFrames; ++k) {
    renderer.set_light(0, moved(scene.lights[0], k, kFrames));
    std::vector<std::vector<float>> now;
    for (std::size_t m = 0; m < methods.size(); ++m) {
      const RenderResult frame = renderer.render(options_of(methods[m]));
      now.push_back(frame.lights[0].visibility);
      const std::string plan = choices_of(frame.lights[0]);
      if (k > 0 && plan != plans[m]) ++changes[m].plans;
      plans[m] = plan;
      if (k > 0 && m > 0) changes[m].add(before[m], now[m], before[0], now[0]);
    }
    before = std::move(now);
  }
  for (std::size_t m = 1; m < methods.size(); ++m) {
    const Changes& c = changes[m];
    const std::string path = name + "/" + methods[m];
    record.add(path + "/change", "1", c.own);
    record.add(path + "/change of rays", "1", c.of_rays);
    record.add(path + "/apart", "1", c.apart);
    record.add(path + "/apart, most of all frames", "1", *std::ranges::max_element(c.apart));
    record.add(path + "/apart, most of all pixels", "1", *std::ranges::max_element(c.largest));
    record.add(path + "/plans that changed", "1", c.plans);
  }
}

}  // namespace

void bench_pops(Record& record, const SceneNames& scenes) {
  for (const std::string& name : scenes) measure(record, name);
}

}  // namespace penumbra::bench
