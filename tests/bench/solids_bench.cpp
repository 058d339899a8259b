// Solids: time, triangles and share of proved triangles; soundness by CGAL; points and proved triangles by
// rays in double.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <random>

#include "apps/common/scene_volumes.h"
#include "penumbra/volumes/checks/validate.h"
#include "tests/bench/bench_support.h"
#include "tests/render/oracle_support.h"
#include "tests/render/solids/solid_judge.h"

namespace penumbra::bench {
namespace {

constexpr std::size_t kPoints = 1'000'000;       ///< half of them near the surface
constexpr std::size_t kCarefulPoints = 20'000;   ///< with more rays: how much is missed
constexpr std::size_t kProvedTriangles = 1'000;  ///< at ten points each
constexpr double kInward = 1e-4;                 ///< of the tolerance, see contradicted
constexpr int kRuns = 3;
constexpr int kQuick = 48, kCareful = 1'024;  ///< rays a point

struct Subject {
  explicit Subject(const std::string& name) {
    const std::filesystem::path data(PENUMBRA_DATA);
    scene = name.ends_with(".ply") ? load_scene(data / "meshes" / name).scene : bench_scene(name);
    meshes = testing::casting_meshes(scene);
    for (const SceneObject& object : scene.objects)
      if (object.casts) objects.push_back(object);
  }
  oracle::Light light() const { return testing::oracle_light(shape_of(scene)); }

  Scene scene;
  std::vector<SceneObject> objects;
  std::vector<TriangleMesh> meshes;
};

/// Points on triangles that are called proved, and contradicted by some ray. The umbra of one convex body is
/// exact: its triangles lie in the body's lit faces and in planes that touch the light, so that it is points
/// a little inside that are in umbra.
std::size_t contradicted(const ShadowSolid& solid, bool umbra, const oracle::Oracle& oracle,
                         const oracle::Light& light) {
  std::vector<std::size_t> proved;
  for (std::size_t i = 0; i < solid.is_proved.size(); ++i)
    if (solid.is_proved[i]) proved.push_back(i);
  std::mt19937_64 random(7);
  std::ranges::shuffle(proved, random);
  proved.resize(std::min(proved.size(), kProvedTriangles));
  std::vector<Vec3> points;
  const double inward = umbra && solid.grid_points == 0 ? kInward * solid.tolerance : 0.0;
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (const std::size_t i : proved)
    for (int k = 0; k < 10; ++k) {
      const IndexedTriangle& t = solid.mesh.triangles[i];
      const auto& p = solid.mesh.positions;
      const double s = std::sqrt(unit(random)), u = unit(random);
      const Vec3 outward = glm::normalize(glm::cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]));
      points.push_back((1.0 - s) * p[t[0]] + s * (1.0 - u) * p[t[1]] + s * u * p[t[2]] - inward * outward);
    }
  std::atomic<std::size_t> found{0};
  tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t i) {
    const double seen = oracle.unoccluded(points[i], {}, light, 256, i);
    if (umbra ? seen > 0.0 : seen < 1.0) ++found;
  });
  return found;
}

ShadowSolid solid_of(const Subject& subject, const Casters& casters, bool umbra) {
  const ShadowLevel level{umbra ? ShadowLevel::Kind::kUmbra : ShadowLevel::Kind::kPenumbra};
  return extrude_solid(casters, shape_of(subject.scene), level,
                       {.bound = apps::solid_bound_for(subject.scene)});
}

std::string path_of(const std::string& name, bool umbra) {
  return name + (umbra ? "/umbra" : "/penumbra");
}

double share(std::size_t part, std::size_t whole) {
  return whole > 0 ? static_cast<double>(part) / static_cast<double>(whole) : 0.0;
}

void time_solid(Record& record, const std::string& name, const Subject& subject, bool umbra) {
  const Casters casters(subject.objects);
  const std::string path = path_of(name, umbra);
  std::vector<double> times;
  ShadowSolid solid;
  for (int i = 0; i < kRuns; ++i) {
    const auto start = std::chrono::steady_clock::now();
    solid = solid_of(subject, casters, umbra);
    times.push_back(
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
  }
  record.add(path + "/time", "ms", times);
  record.add(path + "/triangles", "1", static_cast<double>(solid.mesh.triangles.size()));
  record.add(path + "/proved", "1", share(solid.proved, solid.to_prove));
}

void judge(Record& record, const std::string& name, const Subject& subject, const oracle::Oracle& oracle,
           bool umbra) {
  const Casters casters(subject.objects);
  const ShadowSolid solid = solid_of(subject, casters, umbra);
  const SurfaceFindings f = check_surface(solid.mesh.positions, solid.mesh.triangles);
  const bool sound = f.triangles == 0 || (f.closed() && f.degenerate.empty() &&
                                          f.self_intersections.empty() && f.bounds_a_volume);
  const CircularLight circular = require_circular(shape_of(subject.scene), "solids");
  SolidPoints points{.count = kPoints,
                     .box = solid.mesh.triangles.empty() ? apps::solid_bound_for(subject.scene)
                                                         : bounds_of(solid.mesh.positions),
                     .near = solid.tolerance,
                     .samples = kQuick};
  const SolidFigures many = judge_solid(solid.mesh, umbra, oracle, subject.light(), circular, points);
  points.count = kCarefulPoints;
  points.samples = kCareful;
  points.seed = 2;
  const SolidFigures careful = judge_solid(solid.mesh, umbra, oracle, subject.light(), circular, points);
  const std::string path = path_of(name, umbra);
  record.add(path + "/sound", "1", sound ? 1.0 : 0.0);
  record.add(path + "/volume", "scene units^3", solid.volume);
  record.add(path + "/points", "1", static_cast<double>(many.points + careful.points));
  record.add(path + "/wrong points", "1", static_cast<double>(many.wrong + careful.wrong));
  record.add(path + "/worst point", "1", std::max(many.worst, careful.worst));
  record.add(path + (umbra ? "/missed" : "/surplus"), "1",
             share(umbra ? careful.missed : careful.surplus, careful.region));
  record.add(path + "/contradicted proofs", "1",
             static_cast<double>(contradicted(solid, umbra, oracle, subject.light())));
  std::fflush(stdout);
}

}  // namespace

void bench_solids(Record& record, const SceneNames& scenes) {
  for (const std::string& name : scenes) {
    const Subject subject(name);
    for (const bool umbra : {true, false}) time_solid(record, name, subject, umbra);
  }
}

void bench_solids_judge(Record& record, const SceneNames& scenes) {
  for (const std::string& name : scenes) {
    const Subject subject(name);
    const oracle::Oracle oracle(subject.meshes);
    for (const bool umbra : {true, false}) judge(record, name, subject, oracle, umbra);
  }
}

}  // namespace penumbra::bench
