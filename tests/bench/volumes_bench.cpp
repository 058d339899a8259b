// Penumbra volumes with one cell a patch of faces against one cell a face, and umbra volumes.
#include <chrono>
#include <string>
#include <vector>

#include "penumbra/mesh/shapes.h"
#include "penumbra/volumes/convex_umbra.h"
#include "penumbra/volumes/extrude.h"
#include "tests/bench/bench_support.h"

namespace penumbra::bench {
namespace {

constexpr int kRuns = 5;

template <class Call>
double milliseconds(Call call) {
  const auto start = std::chrono::steady_clock::now();
  call();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

void record_volume(Record& record, const std::string& path, const ShadowMesh& volume,
                   const std::vector<double>& times) {
  record.add(path + "/cells", "1", static_cast<double>(volume.cells));
  record.add(path + "/triangles", "1", static_cast<double>(volume.triangles.size()));
  record.add(path + "/time", "ms", times);
}

/// Both kinds of penumbra volume in turn.
void compare_cells(Record& record, const std::string& name) {
  const Scene scene = bench_scene(name);
  const TriangleMesh& mesh = scene.objects.back().mesh;
  const Classification classes = classify_faces(mesh, testing::light_of(scene));
  ExtrudeOptions patches, faces;
  faces.merge_faces = false;
  ShadowMesh merged, single;
  std::vector<double> merged_times, single_times;
  for (int i = 0; i < kRuns; ++i) {
    merged_times.push_back(
        milliseconds([&] { merged = extrude_penumbra(mesh, testing::light_of(scene), classes, patches); }));
    single_times.push_back(
        milliseconds([&] { single = extrude_penumbra(mesh, testing::light_of(scene), classes, faces); }));
  }
  record.add(name + "/faces", "1", static_cast<double>(mesh.triangles().size()));
  record_volume(record, name + "/a cell a face", single, single_times);
  record_volume(record, name + "/a cell a patch", merged, merged_times);
  record.add(name + "/patch : face", "1", paired_ratios(merged_times, single_times));
}

void time_umbra(Record& record, const std::string& name, const TriangleMesh& mesh, const DiskLight& light) {
  const Classification classes = classify_faces(mesh, light);
  std::vector<double> times;
  for (int i = 0; i < kRuns; ++i) times.push_back(milliseconds([&] { convex_umbra(mesh, light, classes); }));
  record.add(name + "/umbra", "ms", times);
}

}  // namespace

void bench_volumes(Record& record, const SceneNames& scenes) {
  for (const std::string& name : scenes) compare_cells(record, name);
  const DiskLight light = testing::light_of(bench_scene("sphere-medium"));
  for (int level = 2; level <= 6; ++level) {
    const TriangleMesh sphere = make_icosphere({0, 2.5, 0}, 1.0, level);
    time_umbra(record, "sphere of " + std::to_string(sphere.triangles().size()) + " faces", sphere, light);
  }
  for (const char* name : {"building", "decorativePlant-medium"}) {
    const Scene scene = bench_scene(name);
    time_umbra(record, name, scene.objects.back().mesh, testing::light_of(scene));
  }
}

}  // namespace penumbra::bench
