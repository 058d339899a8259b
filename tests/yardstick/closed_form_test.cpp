// The closed form of the yardstick against counting, and against the oracle.
#include "tests/yardstick/closed_form.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "tests/oracle/oracle.h"

namespace penumbra::yardstick {
namespace {

TEST(ClosedForm, KnownAreas) {
  const double pi = std::numbers::pi;
  const auto square = [](double half, double x, double y) {
    return std::vector<Point>{
        {x - half, y - half}, {x + half, y - half}, {x + half, y + half}, {x - half, y + half}};
  };
  EXPECT_NEAR(area_in_unit_disk(square(2, 0, 0)), pi, 1e-14) << "all of the disk";
  EXPECT_NEAR(area_in_unit_disk(square(1e9, 0, 0)), pi, 1e-14);
  EXPECT_NEAR(area_in_unit_disk(square(0.5, 0.1, -0.1)), 1.0, 1e-14) << "all of the square";
  EXPECT_NEAR(area_in_unit_disk(square(0.5, 3, 0)), 0.0, 1e-14) << "nothing";
  EXPECT_NEAR(area_in_unit_disk(square(0.5, 1.3, 1.3)), 0.0, 1e-14);
  EXPECT_NEAR(area_in_unit_disk(square(5, 5, 0)), pi / 2, 1e-14) << "one half";
  EXPECT_NEAR(area_in_unit_disk(square(5, 5, 5)), pi / 4, 1e-14) << "one quarter";
  EXPECT_NEAR(area_in_unit_disk(square(5, 5.5, 0)), std::acos(0.5) - 0.5 * std::sqrt(0.75), 1e-14)
      << "a segment";
  std::vector<Point> other_way = square(5, 5, 0);
  std::reverse(other_way.begin(), other_way.end());
  EXPECT_NEAR(area_in_unit_disk(other_way), -pi / 2, 1e-14);
}

TEST(ClosedForm, PlatesOfAnyPoseUnderTheOracle) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto point = [&] { return Vec3(uniform(random), uniform(random), uniform(random)); };
  int partial = 0;
  for (int i = 0; i < 200; ++i) {
    const Vec3 center = Vec3(0, 2, 0) + 0.5 * point(), u = 0.7 * point(), v = 0.7 * point();
    const Vec3 corners[] = {center - u - v, center + u - v, center + u + v, center - u + v};
    const IndexedTriangle faces[] = {{0, 1, 2}, {0, 2, 3}};
    const TriangleMesh plate = TriangleMesh::build(corners, faces);
    const oracle::Oracle oracle(std::span(&plate, 1));
    const Vec3 x = 0.2 * point();
    const auto compare = [&](const auto& light) {
      const double area = area_in_unit_disk(seen_on_light(light, x, corners));
      const double expected = 1.0 - std::abs(area) / std::numbers::pi;
      partial += expected > 0.0 && expected < 1.0;
      EXPECT_NEAR(oracle.unoccluded(x, {}, light, 4096, static_cast<std::uint64_t>(i)), expected, 0.005) << i;
    };
    compare(DiskLight{Vec3(0, 8, 0) + point(), Vec3(0, -1, 0) + 0.2 * point(), 1.5});
    compare(DistantLight{Vec3(0, -1, 0) + 0.2 * point(), 20.0});
  }
  EXPECT_GT(partial, 200);
}

}  // namespace
}  // namespace penumbra::yardstick
