// The C++ side of compare.py.
// usage: penumbra_points_bench time SCENE POINTS CALLS METHOD SAMPLES OUT      prints wall and CPU
//                                                                              milliseconds of each call
//        penumbra_points_bench judge SCENE POINTS RAYS OUT                      the same values by rays in
//                                                                               double (tests/oracle)
//
// POINTS and OUT are raw arrays: doubles x y z, and one float a point. The scene's first light is asked
// about.
#include <tbb/parallel_for.h>

#include <chrono>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <string>
#include <vector>

#include "penumbra/mesh/error.h"
#include "penumbra/render/visibility.h"
#include "tests/render/oracle_support.h"

namespace {

using namespace penumbra;

std::vector<Vec3> read_points(const std::string& path) {
  std::ifstream in(path, std::ios::binary | std::ios::ate);
  if (!in) throw UsageError(path + " cannot be read");
  std::vector<Vec3> points(static_cast<std::size_t>(in.tellg()) / sizeof(Vec3));
  in.seekg(0).read(reinterpret_cast<char*>(points.data()),
                   static_cast<std::streamsize>(points.size() * sizeof(Vec3)));
  return points;
}

void write_values(const std::string& path, const std::vector<float>& values) {
  std::ofstream out(path, std::ios::binary);
  out.write(reinterpret_cast<const char*>(values.data()),
            static_cast<std::streamsize>(values.size() * sizeof(float)));
  if (!out) throw SystemError(path + " cannot be written");
}

void time_calls(const Scene& scene, const std::vector<Vec3>& points, int calls,
                const VisibilityOptions& options, const std::string& out) {
  const Casters casters(scene.objects);
  std::vector<float> values;
  for (int i = 0; i < calls; ++i) {
    const auto wall = std::chrono::steady_clock::now();
    const std::clock_t cpu = std::clock();
    values = visibility(casters, scene.lights.at(0).shape, {.points = points}, options).visibility;
    const double cpu_ms = 1e3 * static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC;
    const std::chrono::duration<double, std::milli> wall_ms = std::chrono::steady_clock::now() - wall;
    std::printf("%.3f %.3f\n", wall_ms.count(), cpu_ms);
  }
  write_values(out, values);
}

void judge(const Scene& scene, const std::vector<Vec3>& points, int rays, const std::string& out) {
  const oracle::Light light = testing::oracle_light(scene.lights.at(0).shape);
  const std::vector<TriangleMesh> casters = testing::casting_meshes(scene);
  const oracle::Oracle oracle(casters);
  std::vector<float> values(points.size());
  tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t i) {
    values[i] = static_cast<float>(oracle.unoccluded(points[i], {}, light, rays, i));
  });
  write_values(out, values);
}

}  // namespace

int main(int argc, char** argv) try {
  const std::vector<std::string> words(argv + 1, argv + argc);
  const bool times = words.size() == 7 && words[0] == "time";
  if (!times && !(words.size() == 5 && words[0] == "judge")) {
    std::fputs("usage: see the head of tests/apps/python/bench/points_bench.cpp\n", stderr);
    return 2;
  }
  const Scene scene = load_scene(words[1]).scene;
  const std::vector<Vec3> points = read_points(words[2]);
  if (!times) return judge(scene, points, std::stoi(words[3]), words[4]), 0;
  VisibilityOptions options{.method = words[4]};
  if (words[5] != "-") options.options["samples"] = std::uint64_t{std::stoul(words[5])};
  time_calls(scene, points, std::stoi(words[3]), options, words[6]);
} catch (const std::exception& e) {
  std::fprintf(stderr, "penumbra_points_bench: %s\n", e.what());
  return 1;
}
