// Methods against the oracle: rays in double without offset, which share nothing with what they judge.
#include <algorithm>

#include "apps/cli/compare/comparison.h"
#include "penumbra/render/renderer.h"
#include "tests/bench/bench_support.h"

namespace penumbra::bench {
namespace {

constexpr std::size_t kPixels = 20'000;  // of those that see a surface, chosen by chance
constexpr int kOracleRays = 1'024, kReferenceRays = 4'096;

/// Every scene of data/scenes and of data/regressions/scenes that has one light, and no rectangle.
SceneNames all_scenes() {
  SceneNames names;
  for (const char* folder : {PENUMBRA_DATA "/scenes", PENUMBRA_DATA "/regressions/scenes"})
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      if (entry.path().extension() != ".json") continue;
      const Scene scene = load_scene(entry.path()).scene;
      if (scene.lights.size() == 1 && !std::holds_alternative<RectangleLight>(shape_of(scene)))
        names.push_back(entry.path().stem().string());
    }
  std::ranges::sort(names);
  return names;
}

bool takes(const std::string& method, const LightShape& light) {
  try {
    require_taken(method_named(method), light);
    return true;
  } catch (const UsageError&) {
    return false;
  }
}

/// RMSE of the reference without its own noise: the mean of (m1 - r1)(m2 - r2), with two seeds each.
double bias(const std::vector<float>& first, const std::vector<float>& second,
            const apps::Comparison& judged) {
  double sum = 0.0;
  for (std::size_t k = 0; k < judged.penumbra.size(); ++k) {
    const std::uint32_t i = judged.penumbra[k];
    sum += (first[k] - judged.first[i]) * (second[k] - judged.second[i]);
  }
  return std::sqrt(std::max(0.0, sum / static_cast<double>(judged.penumbra.size())));
}

/// The reference, at the pixels that are judged in true penumbra.
void measure_reference(Record& record, const std::string& name, const Scene& scene,
                       const SurfaceBuffer& surface, const apps::Comparison& judged) {
  if (judged.penumbra.empty()) return;
  const RayScene rays(scene, 0);
  const auto trace = [&](std::uint64_t seed) {
    return trace_reference(rays, shape_of(scene), surface.receivers(), judged.penumbra,
                           {.samples = kReferenceRays, .seed = seed})
        .visibility;
  };
  const std::vector<float> first = trace(101), second = trace(102);
  std::vector<float> picture(surface.size(), 1.0f);
  for (std::size_t k = 0; k < first.size(); ++k) picture[judged.penumbra[k]] = first[k];
  record.add(name + "/reference", "1",
             error_figures(picture, judged.first, judged.second, judged.penumbra).rmse);
  record.add(name + "/reference without noise", "1", bias(first, second, judged));
}

void add(Record& record, const std::string& name, const apps::Comparison& judged) {
  record.add(name, "1", judged.in_penumbra.rmse);
  record.add(name + " at most", "1", judged.in_penumbra.max_absolute);
  if (judged.certified > 0)
    record.add(name + " contradicted", "pixels", static_cast<double>(judged.contradicted));
}

void measure(Record& record, const std::string& name) {
  Renderer renderer(bench_scene(name));
  const Scene& scene = renderer.scene();
  apps::SceneComparison judge(scene, {}, {.samples = kOracleRays, .oracle_pixels = kPixels});
  bool is_first = true;
  for (const char* method : {"silhouette", "dbuffer", "occlusion-textures"}) {
    if (!takes(method, shape_of(scene))) continue;
    const RenderResult picture = renderer.render({.method = method});
    const apps::Comparison judged = judge.compare(picture.image);
    if (is_first)
      record.add(name + "/pixels in penumbra", "pixels", static_cast<double>(judged.penumbra.size()));
    add(record, name + "/" + method, judged);
    if (is_first && takes("reference", shape_of(scene)))
      measure_reference(record, name, scene, picture.surface, judged);
    is_first = false;
  }
}

}  // namespace

void bench_judge(Record& record, const SceneNames& scenes) {
  for (const std::string& name : scenes.empty() ? all_scenes() : scenes) try {
      measure(record, name);
    } catch (const SceneError& e) {
      std::fprintf(stderr, "%s: %s\n", name.c_str(), e.what());
    }
}

}  // namespace penumbra::bench
