#include "penumbra/volumes/tangent_planes.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <numbers>

#include "penumbra/volumes/predicates/predicates.h"
#include "tests/volumes/random_inputs.h"

namespace penumbra {
namespace {

const DiskLight kLight{{0, 0, 10}, {0, 0, -1}, 5.0};

TEST(TangentPlanes, OfAnEdgeParallelToTheLight) {
  const auto planes = tangent_planes({8, 0, 0}, {8, 1, 0}, kLight);
  ASSERT_TRUE(planes);
  for (const TangentPlane& plane : *planes) {
    EXPECT_NEAR(std::abs(plane.contact.x), 5.0, 1e-14);
    EXPECT_NEAR(plane.contact.y, 0.0, 1e-14);
    EXPECT_NEAR(plane.contact.z, 10.0, 1e-14);
    EXPECT_NEAR(glm::dot(plane.normal, plane.contact - Vec3(8, 0, 0)), 0.0, 1e-14);
  }
  EXPECT_LT((*planes)[0].contact.x * (*planes)[1].contact.x, 0.0);
}

TEST(TangentPlanes, OfAnEdgePerpendicularToTheLight) {
  const auto planes = tangent_planes({13, 0, 0}, {13, 0, 1}, kLight);
  ASSERT_TRUE(planes);
  EXPECT_NEAR((*planes)[0].contact.x, 25.0 / 13, 1e-14);
  EXPECT_NEAR(std::abs((*planes)[0].contact.y), 60.0 / 13, 1e-14);
  EXPECT_NEAR((*planes)[0].contact.y, -(*planes)[1].contact.y, 1e-14);
}

TEST(TangentPlanes, NoneWhereTheLineCrossesTheDisk) {
  EXPECT_FALSE(tangent_planes({1, 2, 0}, {1, 2, 1}, kLight));
  EXPECT_FALSE(tangent_planes({0, 4, 10}, {1, 4, 10}, kLight));
  const DiskLight point{{0, 0, 10}, {0, 0, -1}, 0.0};
  EXPECT_FALSE(tangent_planes({0, 0, 0}, {0, 0, 1}, point));
}

TEST(TangentPlanes, OneDoublePlaneWhereTheLineTouchesTheRim) {
  const auto planes = tangent_planes({3, 4, 0}, {3, 4, 1}, kLight);
  ASSERT_TRUE(planes);
  for (const TangentPlane& plane : *planes) {
    EXPECT_NEAR(glm::length(plane.contact - Vec3(3, 4, 10)), 0.0, 1e-6);
    EXPECT_NEAR(glm::length(plane.normal - Vec3(-0.6, -0.8, 0)), 0.0, 1e-6);
  }
}

TEST(TangentPlanes, CoincidingPlanesFaceOppositeWays) {
  const DiskLight point{{0, 0, 10}, {0, 0, -1}, 0.0};
  for (const auto& [light, a, b] :
       {std::tuple{point, Vec3(8, 0, 0), Vec3(8, 1, 0)}, std::tuple{kLight, Vec3(8, 0, 10), Vec3(8, 1, 10)},
        std::tuple{kLight, Vec3(-8, 0, 10), Vec3(-8, 1, 10)},
        std::tuple{kLight, Vec3(0, 5, 10), Vec3(1, 5, 10)}}) {
    const auto planes = tangent_planes(a, b, light);
    ASSERT_TRUE(planes);
    EXPECT_NEAR(glm::length((*planes)[0].normal + (*planes)[1].normal), 0.0, 1e-14);
    EXPECT_EQ((*planes)[0].contact, light.center);
    EXPECT_NEAR(glm::dot((*planes)[0].normal, light.center - a), 0.0, 1e-14);
    // The predicate says the same of a point off the plane.
    const Vec3 q(3, 1, 4);
    if (line_outside_disk(a, b, light) != Sign::kPositive) continue;
    for (int i = 0; i < 2; ++i) {
      const double side = glm::dot((*planes)[i].normal, q - a);
      EXPECT_EQ(side > 0, side_of_tangent_plane(a, b, q, static_cast<Tangent>(i), light) == Sign::kPositive);
    }
  }
}

CircularLight random_light(testing::RandomInputs& random, bool distant) {
  const Vec3 normal = random.direction() * random.uniform(0.1, 9.0);
  if (distant) return DistantLight{normal, random.uniform(0, 150)};
  return {random.uniform_point(), normal, random.uniform(0, 1)};
}

class TangentPlanesOf : public ::testing::TestWithParam<bool> {};

INSTANTIATE_TEST_SUITE_P(Lights, TangentPlanesOf, ::testing::Bool(),
                         [](const auto& each) { return each.param ? "distant" : "disk"; });

TEST_P(TangentPlanesOf, RandomEdgesAgreeWithBruteForceOverTheRim) {
  constexpr std::uint64_t kSeed = 7;
  testing::RandomInputs random(kSeed);
  for (int k = 0; k < 2000; ++k) {
    const CircularLight light = random_light(random, GetParam());
    const Vec3 a = random.uniform_point(2.0);
    // Every fifth edge parallel to the light, every fifth perpendicular.
    Vec3 e = random.direction();
    const LightFrame frame = light_frame(light);
    if (k % 5 == 0) e = std::cos(k) * frame.u + std::sin(k) * frame.v;
    if (k % 5 == 1) e = frame.w;
    const Vec3 b = a + e;
    const auto planes = tangent_planes(a, b, light);
    ASSERT_EQ(planes.has_value(), line_outside_disk(a, b, light) != Sign::kNegative)
        << "seed " << kSeed << " input " << k;
    if (!planes) continue;
    const Vec3 center = light.is_distant() ? -frame.w : light.center, to_center = way_to_center(light, a);
    for (int i = 0; i < 2; ++i) {
      const TangentPlane& plane = (*planes)[i];
      SCOPED_TRACE("seed " + std::to_string(kSeed) + " input " + std::to_string(k));
      ASSERT_NEAR(glm::length(plane.normal), 1.0, 1e-14);
      ASSERT_NEAR(glm::dot(plane.normal, e), 0.0, 1e-12);
      ASSERT_NEAR(glm::length(plane.contact - center), light.radius, 1e-12);
      ASSERT_NEAR(glm::dot(plane.contact - center, frame.w), 0.0, 1e-12);
      ASSERT_NEAR(glm::length(plane.way - (to_center + (plane.contact - center))), 0.0, 1e-14);
      double least = std::numeric_limits<double>::infinity();
      for (int j = 0; j < 720; ++j) {
        const double t = 2 * std::numbers::pi * j / 720;
        const Vec3 way = to_center + light.radius * (std::cos(t) * frame.u + std::sin(t) * frame.v);
        least = std::min(least, glm::dot(plane.normal, way));
      }
      ASSERT_GE(least, -1e-12);                       // the disk on the positive side
      ASSERT_LE(least, 1e-4 * light.radius + 1e-12);  // and touching
      const double turn = glm::dot(glm::cross(e, plane.way), to_center);
      ASSERT_GE(i == 0 ? turn : -turn, -1e-12);  // kFirst, kSecond as defined
      // The exact predicate agrees with the normal away from the plane.
      const Vec3 q = random.uniform_point(3.0);
      const double side = glm::dot(plane.normal, q - a);
      if (std::abs(side) < 1e-9 || line_outside_disk(a, b, light) != Sign::kPositive) continue;
      ASSERT_EQ(side_of_tangent_plane(a, b, q, static_cast<Tangent>(i), light),
                side > 0 ? Sign::kPositive : Sign::kNegative);
    }
  }
}

TEST(TangentPlanes, AtExtremeScales) {
  for (const double s : {1e-150, 1e-100, 1e100, 1e150}) {
    const DiskLight light{{0, 0, 10 * s}, {0, 0, -1 / s}, 5 * s};
    const auto planes = tangent_planes({13 * s, 0, 0}, {13 * s, 0, s}, light);
    ASSERT_TRUE(planes);
    EXPECT_NEAR((*planes)[0].contact.x / s, 25.0 / 13, 1e-13) << s;
  }
}

}  // namespace
}  // namespace penumbra
