#include "tests/bench/plan/random_scenes.h"

#include <array>
#include <glm/geometric.hpp>

#include "penumbra/mesh/io/polygon_soup.h"
#include "penumbra/mesh/shapes.h"

namespace penumbra::bench {
namespace {

/// Of data/meshes, moved and scaled to a size about a point.
TriangleMesh data_mesh(const char* file, const Vec3& at, double size) {
  const TriangleMesh mesh = read_mesh(std::filesystem::path(PENUMBRA_DATA) / "meshes" / file);
  const Bounds bounds = mesh.bounds();
  std::vector<Vec3> points(mesh.positions().begin(), mesh.positions().end());
  for (Vec3& p : points) p = at + size / bounds.radius() * (p - bounds.center());
  return TriangleMesh::build(points, mesh.triangles());
}

/// Hills of 2·segments² faces.
TriangleMesh terrain(double half, int segments, Random& random) {
  const TriangleMesh flat = make_plane(half, segments);
  std::vector<Vec3> points(flat.positions().begin(), flat.positions().end());
  const double x = random.uniform(0.5, 3.0), z = random.uniform(0.5, 3.0), high = random.spread(0.05, 0.6);
  for (Vec3& p : points)
    p.y += high * (std::sin(x * p.x) * std::cos(z * p.z) + 0.3 * std::sin(5.0 * p.x + 3.0 * p.z));
  return TriangleMesh::build(points, flat.triangles());
}

TriangleMesh random_caster(Random& random, std::uint64_t seed) {
  const Vec3 at{random.uniform(-2.5, 2.5), random.uniform(0.4, 1.6), random.uniform(-2.5, 2.5)};
  const double size = random.spread(0.2, 1.2);
  constexpr std::array kMeshes{"bunny.ply", "knot1.ply", "armadillo.ply", "refined_elephant.ply",
                               "decorativePlant.ply"};
  switch (static_cast<int>(random.uniform(0, 10))) {
    case 0:
      return make_box(at, size * Vec3(random.spread(0.1, 1), random.spread(0.1, 1), random.spread(0.1, 1)));
    case 1:
      return make_icosphere(at, 0.7 * size, static_cast<int>(random.uniform(1, 6)));
    case 2:
      return make_torus(at, 0.7 * size, 0.2 * size, 64, 16);
    case 3:
      return make_cylinder(at, 0.2 * size, size, 24);
    case 4:
      return make_random_triangles(at, size, random.spread(0.03, 0.4) * size,
                                   static_cast<int>(random.spread(50, 8000)), seed);
    case 5:
      return grass(static_cast<int>(random.spread(50, 5000)), size, seed);
    default:
      return data_mesh(kMeshes[static_cast<std::size_t>(random.uniform(0, 4.999))], at, size);
  }
}

LightShape random_light(Random& random, bool inside) {
  const Vec3 down = Vec3(0, -1, 0) + (inside ? 0.2 : 0.5) * random.point();
  if (!inside && random.uniform(0, 1) < 0.25) return DistantLight{down, random.spread(0.3, 15.0)};
  const Vec3 at{random.uniform(-2, 2), inside ? random.uniform(3.0, 3.7) : random.uniform(3.5, 8.0),
                random.uniform(-2, 2)};
  return DiskLight{at, down, random.spread(0.03, 2.5)};
}

void add_walls(Scene& scene) {
  scene.objects.push_back({.name = "ceiling", .mesh = make_box({0, 4.1, 0}, {4.2, 0.1, 4.2})});
  for (const double side : {-1.0, 1.0}) {
    scene.objects.push_back({.name = "wall", .mesh = make_box({side * 4.1, 2, 0}, {0.1, 2.0, 4.2})});
    scene.objects.push_back({.name = "wall", .mesh = make_box({0, 2, side * 4.1}, {4.2, 2.0, 0.1})});
  }
}

}  // namespace

TriangleMesh soup(int count, double size) {
  Random random(static_cast<std::uint64_t>(count));
  Triangles out;
  const auto near = [&](const Vec3& at) { return at + 1.6 * size * random.point(); };
  for (int i = 0; i < count; ++i) {
    const Vec3 at{random.uniform(-1, 1), random.uniform(0.2, 1.2), random.uniform(-1, 1)};
    const Vec3 a = near(at), b = near(at), c = near(at);
    out.add(a, b, c);
  }
  return out.mesh();
}

TriangleMesh grass(int count, double half, std::uint64_t seed) {
  Random random(seed);
  Triangles out;
  for (int i = 0; i < count; ++i) {
    const Vec3 foot{random.uniform(-half, half), 0.0, random.uniform(-half, half)};
    const Vec3 side = 0.01 * random.point();
    out.add(foot - side, foot + side, foot + Vec3(0, random.uniform(0.1, 0.4), 0) + 0.08 * random.point());
  }
  return out.mesh();
}

TriangleMesh balls(int count) {
  Random random(5);
  std::vector<Vec3> points;
  std::vector<IndexedTriangle> faces;
  for (int i = 0; i < count; ++i) {
    const TriangleMesh ball = make_icosphere(
        {random.uniform(-1.5, 1.5), random.uniform(0.2, 1.7), random.uniform(-1.5, 1.5)}, 0.05, 1);
    const auto first = static_cast<std::uint32_t>(points.size());
    points.insert(points.end(), ball.positions().begin(), ball.positions().end());
    for (const IndexedTriangle& t : ball.triangles())
      faces.push_back({first + t[0], first + t[1], first + t[2]});
  }
  return TriangleMesh::build(points, faces);
}

Scene random_scene(std::uint64_t seed) {
  Random random(seed + 1000);
  Scene scene;
  const double kind = random.uniform(0, 1);
  const bool inside = kind<0.25, hills = kind> 0.75;
  if (hills)
    scene.objects.push_back(
        {.name = "terrain", .mesh = terrain(6.0, static_cast<int>(random.spread(8, 96)), random)});
  else
    scene.objects.push_back({.name = "floor", .mesh = make_plane(6.0), .casts = random.uniform(0, 1) < 0.5});
  if (inside) add_walls(scene);
  const int casters = static_cast<int>(random.spread(1, 9));
  for (int i = 0; i < casters; ++i)
    scene.objects.push_back(
        {.name = "caster", .mesh = random_caster(random, 100 * seed + static_cast<std::uint64_t>(i))});
  const Vec3 target{random.uniform(-1, 1), 0.4, random.uniform(-1, 1)};
  const double angle = random.uniform(0.0, 2.0 * kPi), far = inside ? 3.5 : random.uniform(3.5, 7.0);
  scene.camera = {
      .eye = target + Vec3(far * std::cos(angle), random.uniform(1.0, 3.0), far * std::sin(angle)),
      .target = target,
      .fov_y_degrees = 45.0};
  if (inside) scene.camera.eye = glm::clamp(scene.camera.eye, Vec3(-3.8, 0.3, -3.8), Vec3(3.8, 3.5, 3.8));
  scene.lights.push_back({.shape = random_light(random, inside)});
  return scene;
}

}  // namespace penumbra::bench
