#include "penumbra/volumes/disk_light.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <limits>

#include "penumbra/mesh/error.h"
#include "penumbra/volumes/volumes.h"
#include "tests/volumes/random_inputs.h"

namespace penumbra {
namespace {

TEST(LightFrame, IsRightHandedAtAnyScale) {
  testing::RandomInputs random(3);
  for (const double scale : {1e-300, 1.0, 1e300}) {
    for (int k = 0; k < 100; ++k) {
      const DiskLight light{Vec3(0.0), random.direction() * scale, 1.0};
      const LightFrame f = light_frame(light);
      ASSERT_NEAR(glm::length(glm::cross(f.u, f.v) - f.w), 0.0, 1e-14);
      ASSERT_NEAR(glm::length(f.u), 1.0, 1e-14);
      ASSERT_NEAR(glm::dot(f.u, f.w), 0.0, 1e-14);
      ASSERT_GT(glm::dot(f.w, light.normal / scale), 0.9);
    }
  }
}

TEST(ExtremePoints, AgreeWithBruteForce) {
  constexpr std::uint64_t kSeed = 5;
  testing::RandomInputs random(kSeed);
  for (int k = 0; k < 1000; ++k) {
    const DiskLight light{random.uniform_point(), random.direction() * 3.0, random.uniform(0, 2)};
    const Vec3 n = random.direction();
    const ExtremePoints found = extreme_points(light, n);
    const LightFrame f = light_frame(light);
    double most = -1e300, least = 1e300;
    for (int j = 0; j < 2000; ++j) {
      const double t = 2 * 3.14159265358979 * j / 2000;
      const double height =
          glm::dot(n, light.center + light.radius * (std::cos(t) * f.u + std::sin(t) * f.v));
      most = std::max(most, height);
      least = std::min(least, height);
    }
    ASSERT_NEAR(glm::dot(n, found.near), most, 1e-5) << "seed " << kSeed << " input " << k;
    ASSERT_NEAR(glm::dot(n, found.far), least, 1e-5) << "seed " << kSeed << " input " << k;
    ASSERT_GE(glm::dot(n, found.near), most - 1e-12) << "seed " << kSeed << " input " << k;
  }
}

TEST(ExtremePoints, OfADistantLightAreDirections) {
  constexpr std::uint64_t kSeed = 6;
  testing::RandomInputs random(kSeed);
  for (int k = 0; k < 1000; ++k) {
    const CircularLight light = DistantLight{random.direction() * 3.0, random.uniform(0, 120)};
    const Vec3 n = random.direction(), m = light_frame(light).w;
    const ExtremePoints found = extreme_points(light, n);
    const double across = light.radius * glm::length(glm::cross(n, m));
    ASSERT_NEAR(glm::dot(n, found.near), across - glm::dot(n, m), 1e-12)
        << "seed " << kSeed << " input " << k;
    ASSERT_NEAR(glm::dot(n, found.far), -across - glm::dot(n, m), 1e-12)
        << "seed " << kSeed << " input " << k;
    ASSERT_NEAR(glm::length(found.near + m), light.radius, 1e-12);
    ASSERT_NEAR(glm::dot(found.near, m), -1.0, 1e-12);
  }
}

TEST(WayToCenter, OfADiskAndOfADistantLight) {
  EXPECT_EQ(way_to_center(DiskLight{{1, 2, 3}, {0, -1, 0}, 1.0}, {1, 0, 0}), Vec3(0, 2, 3));
  EXPECT_EQ(way_to_center(DistantLight{{0, -3, 0}, 1.0}, {1e9, 7, 0}), Vec3(0, 1, 0));
  EXPECT_TRUE(is_behind(DiskLight{{1, 2, 3}, {0, -1, 0}, 1.0}, {1, 2, 0}));
  EXPECT_FALSE(is_behind(DistantLight{{0, -3, 0}, 1.0}, {0, 1e300, 0}));
}

TEST(ExtremePoints, NormalParallelToTheLight) {
  const DiskLight light{{1, 2, 3}, {0, 0, -2}, 4.0};
  EXPECT_EQ(extreme_points(light, {0, 0, 7}).near, light.center);
  EXPECT_EQ(extreme_points(light, Vec3(0.0)).far, light.center);
}

TEST(RequireValid, NamesWhatIsWrong) {
  EXPECT_NO_THROW(require_valid(DiskLight{}));
  EXPECT_THROW(require_valid(DiskLight{Vec3(0.0), Vec3(0.0), 1.0}), UsageError);
  EXPECT_THROW(require_valid(DiskLight{Vec3(0.0), Vec3(0, 0, 1), -1.0}), UsageError);
  EXPECT_THROW(require_valid(DiskLight{Vec3(std::numeric_limits<double>::quiet_NaN()), Vec3(0, 0, 1), 1.0}),
               UsageError);
  EXPECT_NO_THROW(require_valid(DistantLight{}));
  EXPECT_NO_THROW(require_valid(DistantLight{{0, -1e-300, 0}, 0.0}));
  EXPECT_THROW(require_valid(DistantLight{Vec3(0.0), 1.0}), UsageError);
  EXPECT_THROW(require_valid(DistantLight{{0, std::numeric_limits<double>::infinity(), 0}, 1.0}), UsageError);
  for (const double angle : {-1.0, 180.0, 400.0, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW(require_valid(DistantLight{{0, -1, 0}, angle}), UsageError) << angle;
}

}  // namespace
}  // namespace penumbra
