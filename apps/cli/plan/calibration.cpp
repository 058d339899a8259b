#include "apps/cli/plan/calibration.h"

#include <algorithm>
#include <cmath>

#include "penumbra/mesh/shapes.h"
#include "penumbra/render/renderer.h"
#include "render/plan/cost_model.h"

namespace penumbra::apps {
namespace {

Scene calibration_scene() {
  Scene scene;
  scene.camera = {.eye = {3, 3.5, 5}, .target = {0, 0.4, 0}, .fov_y_degrees = 40.0};
  scene.lights.push_back({.shape = DiskLight{{0, 4, 0}, {0, -1, 0}, 0.5}});
  scene.objects.push_back({.name = "ball", .mesh = make_icosphere({-0.6, 0.8, 0}, 0.5, 4)});
  scene.objects.push_back(
      {.name = "leaves", .mesh = make_random_triangles({0.7, 0.8, 0}, 0.6, 0.1, 1000, 1)});
  scene.objects.push_back({.name = "floor", .mesh = make_plane(6.0), .casts = false});
  return scene;
}

double least_ms(Renderer& renderer, const RenderOptions& options) {
  constexpr int kFrames = 8;
  double least = 1e300;
  for (int i = 0; i < kFrames; ++i) {
    double sum = 0.0;
    const RenderResult drawn = renderer.render(options);
    for (const StageTime& stage : drawn.lights.front().stages) sum += stage.milliseconds;
    least = std::min(least, sum);
  }
  return least;
}

}  // namespace

Calibration calibrate(int threads) {
  Renderer renderer(calibration_scene(), threads);
  Calibration out;
  constexpr int kSamples = 64;
  const RenderOptions silhouette{.method = "silhouette"};
  const RenderOptions reference{.method = "reference", .options = {{"samples", std::uint64_t{kSamples}}}};
  out.silhouette_ms = least_ms(renderer, silhouette);
  out.reference_ms = least_ms(renderer, reference);
  const LightFacts facts = renderer.plan({}, silhouette.width, silhouette.height).front().facts;
  out.speed = std::sqrt(detail::cost_of_silhouette(facts).frame / out.silhouette_ms *
                        detail::cost_of_reference(facts, kSamples).frame / out.reference_ms);
  return out;
}

}  // namespace penumbra::apps
