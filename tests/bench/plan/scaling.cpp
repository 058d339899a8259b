#include "tests/bench/plan/scaling.h"

#include <algorithm>
#include <cmath>

#include "penumbra/mesh/shapes.h"
#include "penumbra/render/renderer.h"
#include "tests/bench/plan/random_scenes.h"

namespace penumbra::bench {
namespace {

/// Tori on a floor that the camera sees, and others in rows behind the camera.
Scene tori(int seen, int unseen) {
  Scene scene;
  scene.camera = {.eye = {0, 4, 6}, .target = {0, 0.3, 0}, .fov_y_degrees = 45.0};
  const TriangleMesh torus = make_torus({0, 0, 0}, 0.35, 0.12, 64, 16);
  const auto add = [&](const Vec3& at) {
    std::vector<Vec3> points(torus.positions().begin(), torus.positions().end());
    for (Vec3& p : points) p += at;
    scene.objects.push_back({.name = "torus", .mesh = TriangleMesh::build(points, torus.triangles())});
  };
  for (int i = 0; i < seen; ++i) add({1.2 * (i % 5) - 2.4, 0.5, 1.2 * (i / 5) - 1.0});
  for (int i = 0; i < unseen; ++i) add({1.2 * (i % 30) - 18.0, 0.5, 30.0 + 1.2 * (i / 30)});
  scene.objects.push_back({.name = "floor", .mesh = make_plane(6.0), .casts = false});
  return scene;
}

/// Lamps over the floor, and others below it, which shine down.
void add_lights(Scene& scene, int reaching, int others) {
  const auto add = [&](const Vec3& at) {
    scene.lights.push_back(
        {.name = "light-" + std::to_string(scene.lights.size()), .shape = DiskLight{at, {0, -1, 0}, 0.4}});
  };
  for (int i = 0; i < reaching; ++i) add({1.5 * (i - 1), 4.0, 0.3 * i});
  for (int i = 0; i < others; ++i) add({0.1 * i - 5.0, -2.0, 0.0});
}

double sum_of(const StageTimes& stages, const char* name) {
  double sum = 0.0;
  for (const auto& [stage, ms] : stages)
    if (stage == name) sum += ms;
  return sum;
}

/// The least of some frames, and what planning takes of it.
nlohmann::json frame_of(const Scene& scene) {
  constexpr int kFrames = 12;
  Renderer renderer(scene, 1);
  const RenderOptions options{.method = "auto", .width = 320, .height = 240, .leave_out_dark = true};
  RenderResult result;
  double frame = 1e300, plan = 1e300;
  for (int i = 0; i < kFrames; ++i) {
    renderer.forget();
    renderer.render(options, result);
    frame = std::min(frame, result.frame_ms);
    plan = std::min(plan, sum_of(result.stages, "plan"));
  }
  const auto rounded = [](double ms) { return std::round(100.0 * ms) / 100.0; };
  return {{"frame_ms", rounded(frame)}, {"plan_ms", rounded(plan)}};
}

}  // namespace

nlohmann::json measure_scaling() {
  nlohmann::json out;
  const auto casters = [&](int unseen) {
    Scene scene = tori(10, unseen);
    add_lights(scene, 1, 0);
    return frame_of(scene);
  };
  const auto lights = [&](int others) {
    Scene scene = tori(10, 0);
    add_lights(scene, 3, others);
    return frame_of(scene);
  };
  out["10 casters"] = casters(0);
  out["10 casters and 990 that nobody sees a shadow of"] = casters(990);
  out["3 lights"] = lights(0);
  out["3 lights and 97 that reach nothing"] = lights(97);
  return out;
}

}  // namespace penumbra::bench
