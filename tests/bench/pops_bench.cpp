// Whether a frame pops: a light moves for a hundred frames, and the change from each to the next is held
// against the change that rays find, where the plan changes and elsewhere.
#include <algorithm>
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
/// Of the reference. Its noise is in all that is measured: some 0.5 / sqrt(samples) a pixel, twice a change.
constexpr std::uint64_t kSamples = 1024;

RenderOptions options_of(const std::string& method) {
  RenderOptions options{.method = method, .width = kWidth, .height = kHeight};
  if (method == "reference") options.options["samples"] = kSamples;
  return options;
}

/// What a plan chose, in words.
std::string choices_of(const MethodFrame& frame) {
  std::string text;
  for (const Decision& each : frame.decisions) text += each.about + "=" + each.choice + " ";
  return text;
}

/// A change from one frame to the next against that of rays, over the pixels at which the light is partly
/// seen in either by rays: RMS, and the largest difference.
struct Change {
  double own = 0.0, of_rays = 0.0, apart = 0.0, largest = 0.0;
};

Change change_of(const std::vector<float>& before, const std::vector<float>& after,
                 const std::vector<float>& rays_before, const std::vector<float>& rays_after) {
  Change sum;
  double count = 0.0;
  const auto is_partly = [](float v) { return v > 0.0f && v < 1.0f; };
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (!is_partly(rays_before[i]) && !is_partly(rays_after[i])) continue;
    const double own = double{after[i]} - double{before[i]};
    const double of_rays = double{rays_after[i]} - double{rays_before[i]};
    sum.own += own * own;
    sum.of_rays += of_rays * of_rays;
    sum.apart += (own - of_rays) * (own - of_rays);
    sum.largest = std::max(sum.largest, std::abs(own - of_rays));
    ++count;
  }
  const auto rms = [count](double squares) { return std::sqrt(squares / std::max(count, 1.0)); };
  return {rms(sum.own), rms(sum.of_rays), rms(sum.apart), sum.largest};
}

/// All changes of one method, those where its plan changed apart.
class Changes {
 public:
  void add(const Change& change, bool plan_changed) { (plan_changed ? popping_ : steady_).push_back(change); }

  void write(Record& record, const std::string& path) const {
    add_figures(record, path, steady_);
    if (!popping_.empty()) add_figures(record, path + ", plan changes", popping_);
    record.add(path + "/plans that changed", "1", static_cast<double>(popping_.size()));
  }

 private:
  static void add_figures(Record& record, const std::string& path, const std::vector<Change>& changes) {
    const auto all = [&](double Change::*member) {
      std::vector<double> values;
      for (const Change& each : changes) values.push_back(each.*member);
      return values;
    };
    const std::vector<double> apart = all(&Change::apart), largest = all(&Change::largest);
    record.add(path + "/change", "1", all(&Change::own));
    record.add(path + "/change of rays", "1", all(&Change::of_rays));
    record.add(path + "/apart", "1", apart);
    record.add(path + "/apart, most of all frames", "1", *std::ranges::max_element(apart));
    record.add(path + "/apart, most of all pixels", "1", *std::ranges::max_element(largest));
  }

  std::vector<Change> steady_, popping_;
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
      if (k > 0 && m > 0) changes[m].add(change_of(before[m], now[m], before[0], now[0]), plan != plans[m]);
      plans[m] = plan;
    }
    before = std::move(now);
  }
  for (std::size_t m = 1; m < methods.size(); ++m) changes[m].write(record, name + "/" + methods[m]);
}

}  // namespace

void bench_pops(Record& record, const SceneNames& scenes) {
  for (const std::string& name : scenes) measure(record, name);
}

}  // namespace penumbra::bench
