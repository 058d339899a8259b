// What is proved to be in umbra is: triangles behind bodies, against rays in double.
#include "volumes/solids/shafts/hidden_proof.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <random>

#include "penumbra/mesh/shapes.h"
#include "tests/oracle/oracle.h"

namespace penumbra::detail {
namespace {

TEST(HiddenProof, HoldsOnlyWhereNothingOfTheLightIsSeen) {
  const DiskLight light{{0.3, 4.0, 0.2}, {0.0, -1.0, 0.0}, 0.4};
  const std::vector<TriangleMesh> casters{make_torus(Vec3(0.0), 1.0, 0.45, 48, 24),
                                          make_icosphere(Vec3(0.0), 0.3, 3)};
  const CasterTree tree(casters, light);
  const oracle::Oracle oracle(casters);
  HiddenProof proof(tree, light);
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const auto any = [&] { return Vec3(unit(random), unit(random), unit(random)); };
  int proved = 0;
  for (int i = 0; i < 4'000; ++i) {
    const Vec3 middle = 1.6 * any();
    const std::array<Vec3, 3> t{middle + 0.05 * any(), middle + 0.05 * any(), middle + 0.05 * any()};
    if (!proof.holds(t, 1)) continue;
    ++proved;
    for (int k = 0; k < 20; ++k) {
      const double u = 0.5 * (1.0 + unit(random)), v = 0.5 * (1.0 + unit(random)) * (1.0 - u);
      const Vec3 x = t[0] + u * (t[1] - t[0]) + v * (t[2] - t[0]);
      EXPECT_EQ(oracle.unoccluded(x, {}, light, 64, static_cast<std::uint64_t>(i)), 0.0) << i;
    }
  }
  EXPECT_GT(proved, 300);
}

}  // namespace
}  // namespace penumbra::detail
