// Frame by frame while the light moves and the camera stays: all made anew against what is kept from the
// frame before.
#include <chrono>
#include <ctime>
#include <string>
#include <vector>

#include "penumbra/render/renderer.h"
#include "tests/bench/bench_support.h"
#include "tests/bench/moving_light.h"

namespace penumbra::bench {
namespace {

constexpr int kFrames = 50;

struct Clocked {
  std::vector<double> wall, processor, frame, surface, shading;

  /// One frame: its wall clock and its stages.
  void add(Renderer& renderer, const RenderOptions& options, RenderResult& result) {
    const auto start = std::chrono::steady_clock::now();
    const std::clock_t used = std::clock();
    renderer.render(options, result);
    processor.push_back(1e3 * static_cast<double>(std::clock() - used) / CLOCKS_PER_SEC);
    wall.push_back(
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
    frame.push_back(result.frame_ms);
    for (const StageTime& stage : result.stages) {
      if (stage.name == "surface_buffer") surface.push_back(stage.milliseconds);
      if (stage.name == "shading") shading.push_back(stage.milliseconds);
    }
  }
  void write(Record& record, const std::string& path) const {
    record.add(path + "/render", "ms", wall);
    record.add(path + "/processor", "ms of all threads", processor);
    record.add(path + "/frame", "ms", frame);
    record.add(path + "/receivers", "ms", surface);
    record.add(path + "/shading", "ms", shading);
  }
};

void measure(Record& record, const std::string& name, const std::string& method) {
  const Scene scene = bench_scene(name);
  Renderer fresh(scene), keeping(scene);
  const RenderOptions options{.method = method};
  for (Renderer* each : {&fresh, &keeping}) each->render(options);  // warms up
  Clocked anew, kept;
  RenderResult result;
  for (int k = 0; k < kFrames; ++k) {
    const Light light = moved(scene.lights[0], k, kFrames);
    fresh.set_light(0, light);
    keeping.set_light(0, light);
    fresh.forget();
    RenderResult new_result;
    anew.add(fresh, options, new_result);
    kept.add(keeping, options, result);
  }
  const std::string path = name + "/" + method;
  anew.write(record, path + "/anew");
  kept.write(record, path + "/kept");
  record.add(path + "/kept : anew", "1", paired_ratios(kept.wall, anew.wall));
  record.add(path + "/kept : anew, processor", "1", paired_ratios(kept.processor, anew.processor));
}

}  // namespace

void bench_frames(Record& record, const SceneNames& scenes) {
  for (const std::string& name : scenes)
    for (const char* method : {"silhouette", "auto"}) measure(record, name, method);
}

}  // namespace penumbra::bench
