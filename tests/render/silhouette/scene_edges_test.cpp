// The hierarchy over a scene's edges against a look at every face.
#include "render/silhouette/edges/scene_edges.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <set>

#include "penumbra/mesh/shapes.h"
#include "penumbra/volumes/silhouettes.h"
#include "render/rays/ray_scene.h"
#include "tests/render/render_support.h"

namespace penumbra::detail {
namespace {

using testing::Random;
using Pair = std::pair<std::uint32_t, std::uint32_t>;  // object and edge

SceneEdges edges_of(const Scene& scene) {
  const RayFrame frame = frame_of_all_objects(scene);
  return {scene, frame.origin, frame.scale};
}

/// By the exact class of every face.
std::set<Pair> exact_band(const Scene& scene, const DiskLight& light) {
  std::set<Pair> out;
  for (std::uint32_t object = 0; object < scene.objects.size(); ++object) {
    const SceneObject& o = scene.objects[object];
    if (!o.casts) continue;
    const Classification classes = classify_faces(o.mesh, light);
    for (std::uint32_t i = 0; i < o.mesh.edges().size(); ++i)
      if (is_in_band(o.mesh.edges()[i], classes)) out.emplace(object, i);
  }
  return out;
}

struct Share {
  std::size_t exact = 0, found = 0;
};

/// Nothing of the band is missing, nothing comes twice.
Share expect_all_found(const Scene& scene, const SceneEdges& edges, const DiskLight& light) {
  const std::vector<SceneEdge> found = edges.band_of(light, {});
  std::set<Pair> pairs;
  for (const SceneEdge& e : found) pairs.emplace(e.object, index(e.id));
  EXPECT_EQ(pairs.size(), found.size());
  EXPECT_TRUE(std::ranges::all_of(
      found, [&](const SceneEdge& e) { return index(e.id) < scene.objects[e.object].mesh.edges().size(); }));
  const std::set<Pair> exact = exact_band(scene, light);
  EXPECT_TRUE(std::includes(pairs.begin(), pairs.end(), exact.begin(), exact.end()));
  return {exact.size(), pairs.size()};
}

/// Triangles, tetrahedra and one finely divided sphere, or three triangles at an edge, somewhere.
Scene random_scene(Random& random, const Vec3& middle, double size) {
  Scene scene;
  const auto somewhere = [&] { return middle + size * random.point(); };
  testing::light_of(scene) = {somewhere(), random.direction(), size * random.spread(0.001, 1.0)};
  for (int k = 0; k < 6; ++k) {
    const Vec3 p = somewhere();
    std::vector<Vec3> points;
    for (int i = 0; i < 5; ++i) points.push_back(p + size * random.spread(0.001, 1.0) * random.point());
    std::vector<IndexedTriangle> faces{{0, 1, 2}};
    if (k % 3 == 1) faces.insert(faces.end(), {{0, 3, 1}, {1, 3, 2}, {2, 3, 0}});
    if (k % 3 == 2) faces.insert(faces.end(), {{1, 0, 3}, {0, 1, 4}});
    scene.objects.push_back({"", testing::mesh_of(points, faces), Vec3(0.8), k != 4});
  }
  scene.objects.push_back({"", make_icosphere(somewhere(), size * random.spread(0.01, 1.0), 3), Vec3(0.8)});
  return scene;
}

DiskLight random_light(Random& random, const Scene& scene) {
  const double away = random.spread(0.1, 100.0) * scene.bounds().radius();
  return {scene.bounds().center() + away * random.direction(), random.direction() * random.spread(0.1, 10.0),
          random.spread(1e-6, 2.0) * away};
}

TEST(SceneEdges, FindTheBandOfAnyLight) {
  Random random(61);
  Share all;
  for (int round = 0; round < 60; ++round) {
    const Vec3 middle = round % 3 == 0 ? Vec3(1e5, -3e4, 7.0) : Vec3(0.0);
    const Scene scene = random_scene(random, middle, round % 2 == 0 ? 1.0 : 1e-3);
    const SceneEdges edges = edges_of(scene);
    for (int i = 0; i < 20; ++i) {
      const Share s =
          expect_all_found(scene, edges, i == 0 ? testing::light_of(scene) : random_light(random, scene));
      all.exact += s.exact, all.found += s.found;
    }
  }
  std::printf("%zu edges in the band, %zu found\n", all.exact, all.found);
  EXPECT_GT(all.exact, 100000u);
}

TEST(SceneEdges, FindFewMoreThanTheBand) {
  for (const char* name : {"armadillo-medium", "boxes-small", "foliage-large", "sphere-medium"}) {
    const Scene scene = testing::data_scene(name);
    const Share s = expect_all_found(scene, edges_of(scene), testing::light_of(scene));
    EXPECT_LE(static_cast<double>(s.found), 1.002 * static_cast<double>(s.exact)) << name;
  }
}

/// Planes that touch the rim, that hold the light, and faces without area.
TEST(SceneEdges, KeepWhatTouches) {
  Scene scene = testing::scene_in_light_frame(
      2.0, {make_box({2.5, 0, 1.5}, {0.5, 1, 0.5}), testing::rectangle(-1, 1, -1, 1, 0.0),
            testing::mesh_of({{0, 0, 3}, {1, 0, 3}, {2, 0, 3}, {0, 1, 4}}, {{0, 1, 2}, {0, 2, 3}})});
  const SceneEdges edges = edges_of(scene);
  expect_all_found(scene, edges, testing::light_of(scene));
  testing::light_of(scene).radius = std::nextafter(2.0, 3.0);
  expect_all_found(scene, edges, testing::light_of(scene));
  testing::light_of(scene).radius = std::nextafter(2.0, 1.0);
  expect_all_found(scene, edges, testing::light_of(scene));
}

TEST(SceneEdges, LeaveOutObjectsThatCannotOccludeOrDoNotCast) {
  Random random(62);
  const Scene scene = random_scene(random, Vec3(0.0), 1.0);
  const SceneEdges edges = edges_of(scene);
  std::vector<char> cannot_occlude(scene.objects.size(), 0);
  cannot_occlude[6] = 1;
  std::size_t others = 0;
  for (const SceneEdge& e : edges.band_of(testing::light_of(scene), {})) {
    EXPECT_TRUE(scene.objects[e.object].casts);
    others += e.object != 6 ? 1 : 0;
  }
  const std::vector<SceneEdge> rest = edges.band_of(testing::light_of(scene), cannot_occlude);
  EXPECT_TRUE(std::ranges::all_of(rest, [](const SceneEdge& e) { return e.object != 6; }));
  EXPECT_EQ(rest.size(), others);
}

TEST(SceneEdges, AreTheSameForAnyNumberOfThreads) {
  const Scene scene = testing::data_scene("bunny-medium");
  const auto found = [&](int threads) {
    std::vector<SceneEdge> out;
    tbb::task_arena(threads).execute([&] { out = edges_of(scene).band_of(testing::light_of(scene), {}); });
    return out;
  };
  const std::vector<SceneEdge> one = found(1), two = found(2);
  const auto same = [](const SceneEdge& a, const SceneEdge& b) {
    return a.object == b.object && a.id == b.id;
  };
  EXPECT_TRUE(std::ranges::equal(one, two, same));
}

TEST(SceneEdges, OfNothingAreNone) {
  Scene scene = testing::scene_in_light_frame(1.0, {});
  EXPECT_TRUE(edges_of(scene).band_of(testing::light_of(scene), {}).empty());
  EXPECT_EQ(edges_of(scene).size(), 0u);
}

}  // namespace
}  // namespace penumbra::detail
