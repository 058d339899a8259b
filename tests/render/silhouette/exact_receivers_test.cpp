// Receivers on vertices, edges and faces of what casts, against rays in double that share nothing with the
// method (tests/oracle): a face in whose plane a receiver lies hides nothing from it, all others do.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <glm/geometric.hpp>

#include "penumbra/mesh/shapes.h"
#include "penumbra/render/visibility.h"
#include "tests/oracle/oracle.h"
#include "tests/render/render_support.h"

namespace penumbra {
namespace {

using testing::Random;

/// Points of a mesh: vertices, middles of edges, places on faces.
std::vector<Vec3> points_of(const TriangleMesh& mesh, Random& random, std::size_t count) {
  std::vector<Vec3> out;
  const auto any = [&](std::size_t size) {
    return std::min(size - 1, static_cast<std::size_t>(random.uniform(0.0, 1.0) * static_cast<double>(size)));
  };
  for (std::size_t i = 0; i < count; ++i) {
    const IndexedTriangle& t = mesh.triangles()[any(mesh.triangles().size())];
    const Vec3 a = mesh.positions()[t[0]], b = mesh.positions()[t[1]], c = mesh.positions()[t[2]];
    if (i % 3 == 0) out.push_back(a);
    if (i % 3 == 1) out.push_back(0.5 * (a + b));
    if (i % 3 == 2) out.push_back((0.2 * a + 0.3 * b) + 0.5 * c);
  }
  return out;
}

struct Off {
  double rmse = 0.0, most = 0.0;
  std::size_t partly = 0, wrong = 0;
};

/// O by the method and by the oracle.
Off compare(const TriangleMesh& mesh, const LightShape& light, std::uint64_t seed) {
  Random random(seed);
  const std::vector<Vec3> points = points_of(mesh, random, 120);
  const std::vector<TriangleMesh> meshes{mesh};
  const MethodResult seen = visibility(Casters(meshes), light, {.points = points});
  const oracle::Oracle judge(meshes);
  const oracle::Light of = std::holds_alternative<DiskLight>(light)
                               ? oracle::Light(std::get<DiskLight>(light))
                               : oracle::Light(std::get<DistantLight>(light));
  Off off;
  double sum = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double truth = judge.unoccluded(points[i], {}, of, 1024, seed + i), is = seen.visibility[i];
    if (std::abs(is - truth) > 0.02)
      std::printf("  point %zu (%.17g, %.17g, %.17g): %.4f instead of %.4f, region %d\n", i, points[i].x,
                  points[i].y, points[i].z, is, truth, seen.region[i]);
    off.wrong += (seen.region[i] == 0 && truth < 1.0) || (seen.region[i] == 2 && truth > 0.0);
    if (!(truth > 0.0 && truth < 1.0) && std::abs(is - truth) < 0.01) continue;
    ++off.partly;
    sum += (is - truth) * (is - truth);
    off.most = std::max(off.most, std::abs(is - truth));
  }
  off.rmse = std::sqrt(sum / static_cast<double>(std::max<std::size_t>(1, off.partly)));
  return off;
}

TEST(ExactReceivers, OnWhatCastsSeeWhatRaysInDoubleSee) {
  const std::string data = PENUMBRA_DATA;
  std::size_t partly = 0;
  std::vector<std::pair<std::string, TriangleMesh>> meshes{
      {"box", make_box(Vec3(0.0), {1, 0.5, 0.7})}, {"torus", make_torus(Vec3(0.0), 1.0, 0.4, 24, 16)}};
  for (const char* name : {"bunny.ply", "elephant-with-holes.ply"})
    meshes.emplace_back(name, load_scene(data + "/meshes/" + name).scene.objects.back().mesh);
  for (const auto& [name, mesh] : meshes) {
    const double size = mesh.bounds().radius();
    const Vec3 toward = glm::normalize(Vec3(0.4, 1.0, 0.2)), middle = mesh.bounds().center();
    const std::pair<const char*, LightShape> lights[] = {
        {"near", DiskLight{middle + 2.5 * size * toward, -toward, 0.6 * size}},
        {"far", DiskLight{middle + 1e6 * size * toward, -toward, 2e4 * size}},
        {"distant", DistantLight{-toward, 3.0}}};
    for (const auto& [kind, light] : lights) {
      const Off off = compare(mesh, light, 7);
      std::printf("%-24s %-8s %3zu in penumbra: RMSE %.4f, most %.4f\n", name.c_str(), kind, off.partly,
                  off.rmse, off.most);
      EXPECT_EQ(off.wrong, 0u) << name << ' ' << kind << ": certificates";
      EXPECT_LE(off.rmse, 0.003) << name << ' ' << kind << ": the noise of 1,024 rays is .0016";
      EXPECT_LE(off.most, 0.02) << name << ' ' << kind;
      partly += off.partly;
    }
  }
  EXPECT_GT(partly, 120u);
}

}  // namespace
}  // namespace penumbra
