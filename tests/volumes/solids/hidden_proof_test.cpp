// What is proved to be in umbra is: triangles behind bodies, against rays in double.
#include "volumes/solids/shafts/hidden_proof.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <random>

#include "penumbra/mesh/shapes.h"
#include "tests/oracle/oracle.h"

namespace penumbra::detail {
namespace {

using Triangle = std::array<Vec3, 3>;

struct TorusAroundBall {
  DiskLight light{{0.3, 4.0, 0.2}, {0.0, -1.0, 0.0}, 0.4};
  std::vector<TriangleMesh> casters{make_torus(Vec3(0.0), 1.0, 0.45, 48, 24),
                                    make_icosphere(Vec3(0.0), 0.3, 3)};
  CasterTree tree{casters, light};
  oracle::Oracle oracle{casters};
  std::mt19937_64 random{3};

  double any() { return std::uniform_real_distribution<double>(-1.0, 1.0)(random); }
  Vec3 any_point() { return {any(), any(), any()}; }
  Triangle small_triangle(const Vec3& middle) {
    return {middle + 0.05 * any_point(), middle + 0.05 * any_point(), middle + 0.05 * any_point()};
  }
  /// No point of the triangle sees any of the light, as far as rays tell.
  void expect_hidden(const Triangle& t) {
    for (int k = 0; k < 20; ++k) {
      const double u = 0.5 * (1.0 + any()), v = 0.5 * (1.0 + any()) * (1.0 - u);
      const Vec3 x = t[0] + u * (t[1] - t[0]) + v * (t[2] - t[0]);
      EXPECT_EQ(oracle.unoccluded(x, {}, light, 64, random()), 0.0);
    }
  }
};

TEST(HiddenProof, HoldsOnlyWhereNothingOfTheLightIsSeen) {
  TorusAroundBall scene;
  HiddenProof proof(scene.tree, scene.light);
  int proved = 0;
  for (int i = 0; i < 4'000; ++i) {
    const Triangle t = scene.small_triangle(1.6 * scene.any_point());
    if (!proof.holds(t, {.depth = 1})) continue;
    ++proved;
    scene.expect_hidden(t);
  }
  EXPECT_GT(proved, 300);
}

TEST(HiddenProof, OfAGroupHoldsWhereThatOfOneDoes) {
  TorusAroundBall scene;
  HiddenProof alone(scene.tree, scene.light), thorough(scene.tree, scene.light),
      quick(scene.tree, scene.light);
  int proved_alone = 0, proved_quickly = 0;
  for (int i = 0; i < 1'000; ++i) {
    const Vec3 middle = 1.6 * scene.any_point();
    std::array<Vec3, 8> box;
    for (unsigned k = 0; k < 8; ++k)
      box[k] = middle + 0.15 * Vec3(k & 1 ? 1.0 : -1.0, k & 2 ? 1.0 : -1.0, k & 4 ? 1.0 : -1.0);
    thorough.begin_group(box);
    quick.begin_group(box);
    for (int k = 0; k < 6; ++k) {
      const Triangle t = scene.small_triangle(middle + 0.1 * scene.any_point());
      const bool by_itself = alone.holds(t, {}), by_group = thorough.holds(t, {}),
                 soon = quick.holds(t, {.thorough = false});
      EXPECT_TRUE(by_group || !by_itself);
      proved_alone += by_itself ? 1 : 0;
      proved_quickly += soon ? 1 : 0;
      if (by_group || soon) scene.expect_hidden(t);
    }
  }
  EXPECT_GT(proved_alone, 300);
  EXPECT_GT(proved_quickly, 9 * proved_alone / 10);
}

}  // namespace
}  // namespace penumbra::detail
