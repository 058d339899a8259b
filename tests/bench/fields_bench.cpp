// Fields: 256³ points in a cube around the casters, twice as long as they are.
#include <algorithm>
#include <chrono>

#include "penumbra/render/solids/light_field.h"
#include "tests/bench/bench_support.h"

namespace penumbra::bench {
namespace {

constexpr int kPoints = 256;  ///< along each axis
constexpr int kRuns = 5;

Bounds cube_around(const Bounds& box) {
  const Vec3 size = box.high - box.low;
  const Vec3 half(std::max({size.x, size.y, size.z}));
  Bounds cube;
  cube.add(box.center() - half);
  cube.add(box.center() + half);
  return cube;
}

}  // namespace

void bench_fields(Record& record, const SceneNames& scenes) {
  for (const std::string& name : scenes) {
    const Scene scene = bench_scene(name);
    const Bounds cube = cube_around(scene.caster_bounds());
    std::vector<double> times;
    LightField field;
    for (int i = 0; i < kRuns; ++i) {
      const Casters casters(scene.objects);  // its hierarchies are made anew, too
      const auto start = std::chrono::steady_clock::now();
      field = light_field(casters, shape_of(scene), cube, {kPoints, kPoints, kPoints});
      times.push_back(
          std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
    }
    record.add(name + "/field/time", "ms", times);
    const auto share = [&](const auto& which) {
      return static_cast<double>(std::ranges::count_if(field.seen, which)) /
             static_cast<double>(field.seen.size());
    };
    record.add(name + "/field/umbra", "1", share([](float v) { return v == 0.0f; }));
    record.add(name + "/field/penumbra", "1", share([](float v) { return v > 0.0f && v < 1.0f; }));
  }
}

}  // namespace penumbra::bench
