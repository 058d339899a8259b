// A heightfield of N × N posts under a low sun: time and memory of its tiles, of rays and of exact areas on
// 10,000 posts, exact areas up to 2,000² posts. Memory is the process's peak so far: sizes grow, and what
// takes most comes last.
#include <cmath>
#include <cstdio>
#include <random>

#include "penumbra/render/visibility.h"
#include "render/scene/heightfield/height_tiles.h"
#include "tests/bench/bench_support.h"

namespace penumbra::bench {
namespace {

constexpr std::size_t kReceivers = 10'000;
/// Posts along a side: exact areas of more take many minutes.
constexpr std::size_t kMostForAreas = 2'000;
const LightShape kLowSun = DistantLight{{-0.9, -0.3, 0.35}, 0.53};  // 17 degrees high

/// Hills upon hills, posts 1 apart: each octave is half as long and .55 times as high.
detail::HeightGrid hills(std::size_t side) {
  detail::HeightGrid grid{.columns = side, .rows = side, .heights = {}};
  grid.heights.reserve(side * side);
  for (std::size_t r = 0; r < side; ++r)
    for (std::size_t c = 0; c < side; ++c) {
      double sum = 0.0, height = 60.0, wave = 2.0 * 3.14159 / 500.0;
      for (int octave = 0; octave < 8; ++octave, height *= 0.55, wave *= 2.0) {
        const auto x = static_cast<double>(c), z = static_cast<double>(r);
        sum +=
            height * std::sin(wave * (x + 0.6 * z) + octave) * std::cos(wave * (z - 0.4 * x) + 2.0 * octave);
      }
      grid.heights.push_back(sum);
    }
  return grid;
}

/// Posts by chance, from vertices of tiles by chance.
std::vector<Vec3> some_posts(const Scene& scene) {
  std::mt19937 random(1);
  std::vector<Vec3> points;
  while (points.size() < kReceivers) {
    const auto p = scene.objects[random() % scene.objects.size()].mesh.positions();
    points.push_back(p[random() % p.size()]);
  }
  return points;
}

class TerrainBench {
 public:
  TerrainBench(Record& record, std::size_t side) : record_(record), side_(side), name_(std::to_string(side)) {
    std::printf("terrain of %zu x %zu posts\n", side, side);
    const detail::HeightGrid grid = hills(side);
    clock_.restart();
    for (detail::HeightTile& tile : detail::make_tiles(grid, {}, {}))
      scene_.objects.push_back({.name = "tile", .mesh = std::move(tile.mesh)});
    note("tiles");
  }

  void run() {
    const std::vector<Vec3> points = some_posts(scene_);
    for (const char* method : {"reference", "silhouette"}) {
      if (method == std::string("silhouette") && side_ > kMostForAreas) continue;
      const Casters casters(scene_.objects);
      clock_.restart();
      for (const char* call : {"first", "next"}) {
        const auto seen = visibility(casters, kLowSun, {.points = points}, options_of(method)).visibility;
        note(std::string(method) + "-" + call);
        partly_ = 0;
        for (const float v : seen) partly_ += v > 0.0f && v < 1.0f;
      }
      std::printf("  %zu of %zu posts see a part of the sun\n", partly_, points.size());
    }
  }

 private:
  static VisibilityOptions options_of(const std::string& method) {
    VisibilityOptions options{.method = method};
    if (method == "reference") options.options = {{"samples", std::uint64_t{64}}};
    return options;
  }
  void note(const std::string& what) {
    clock_.finish(what);
    const double ms = clock_.stages().back().milliseconds, memory = peak_memory_mib();
    std::printf("  %-18s %10.0f ms   at most %6.0f MiB so far\n", what.c_str(), ms, memory);
    record_.add(name_ + "/" + what, "ms", ms);
    record_.add(name_ + "/" + what + "-memory", "MiB", memory);
    clock_.restart();
  }

  Record& record_;
  std::size_t side_;
  std::string name_;
  Scene scene_;
  StageClock clock_;
  std::size_t partly_ = 0;
};

}  // namespace

void bench_terrain(Record& record, const SceneNames& sides) {
  for (const std::string& side : sides) TerrainBench(record, std::stoul(side)).run();
}

}  // namespace penumbra::bench
