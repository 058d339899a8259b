#include "penumbra/volumes/predicates/predicates.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "volumes/predicates/predicate_tiers.h"

namespace penumbra {
namespace {

const DiskLight kLight{{0, 0, 10}, {0, 0, -1}, 5.0};

TEST(ClassifyFace, SeesAllNoneOrPart) {
  EXPECT_EQ(classify_face({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, kLight), FaceClass::kAllFront);
  EXPECT_EQ(classify_face({0, 0, 0}, {0, 1, 0}, {1, 0, 0}, kLight), FaceClass::kNoneFront);
  EXPECT_EQ(classify_face({0, 0, 0}, {0, 1, 0}, {0, 0, 1}, kLight), FaceClass::kMixed);
}

TEST(ClassifyFace, TangencyIsMixedAndOneUlpDecides) {
  // The plane x = 5 touches the rim of the disk at (5, 0, 10).
  const auto face_at = [](double x) { return classify_face({x, 0, 0}, {x, 0, 1}, {x, 1, 0}, kLight); };
  EXPECT_EQ(face_at(5.0), FaceClass::kMixed);
  EXPECT_EQ(face_at(std::nextafter(5.0, 6.0)), FaceClass::kAllFront);
  EXPECT_EQ(face_at(std::nextafter(5.0, 4.0)), FaceClass::kMixed);
}

TEST(ClassifyFace, DegenerateFaceIsMixed) {
  EXPECT_EQ(classify_face({0, 0, 0}, {1, 1, 1}, {3, 3, 3}, kLight), FaceClass::kMixed);
  EXPECT_EQ(classify_face({1, 2, 3}, {1, 2, 3}, {1, 2, 3}, kLight), FaceClass::kMixed);
}

TEST(ClassifyFace, PointLight) {
  const DiskLight point{{0, 0, 10}, {0, 0, -1}, 0.0};
  EXPECT_EQ(classify_face({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, point), FaceClass::kAllFront);
  EXPECT_EQ(classify_face({0, 0, 0}, {0, 1, 0}, {0, 0, 1}, point), FaceClass::kMixed);  // edge-on
  const double tiny = std::numeric_limits<double>::denorm_min();
  EXPECT_EQ(classify_face({tiny, 0, 0}, {tiny, 0, 1}, {tiny, 1, 0}, point), FaceClass::kAllFront);
}

TEST(ClassifyFace, FaceParallelToTheLight) {
  EXPECT_EQ(classify_face({50, 0, 10}, {51, 0, 10}, {50, 1, 10}, kLight), FaceClass::kMixed);  // in its plane
  EXPECT_EQ(classify_face({50, 0, 9}, {51, 0, 9}, {50, 1, 9}, kLight), FaceClass::kAllFront);
}

TEST(SideOfLightPlane, IsStrict) {
  EXPECT_EQ(side_of_light_plane({3, 4, 9}, kLight), Sign::kPositive);
  EXPECT_EQ(side_of_light_plane({3, 4, 10}, kLight), Sign::kZero);
  EXPECT_EQ(side_of_light_plane({3, 4, 11}, kLight), Sign::kNegative);
}

TEST(LineOutsideDisk, CrossesTouchesMisses) {
  EXPECT_EQ(line_outside_disk({3, 3.9, 0}, {3, 3.9, 1}, kLight), Sign::kNegative);
  EXPECT_EQ(line_outside_disk({3, 4, 0}, {3, 4, 1}, kLight), Sign::kZero);
  EXPECT_EQ(line_outside_disk({3, 4.1, 0}, {3, 4.1, 1}, kLight), Sign::kPositive);
}

TEST(LineOutsideDisk, ParallelToTheLightsPlane) {
  EXPECT_EQ(line_outside_disk({0, 0, 9}, {1, 0, 9}, kLight), Sign::kPositive);
  EXPECT_EQ(line_outside_disk({0, 4, 10}, {1, 4, 10}, kLight), Sign::kNegative);
  EXPECT_EQ(line_outside_disk({0, 5, 10}, {1, 5, 10}, kLight), Sign::kZero);
  EXPECT_EQ(line_outside_disk({0, 6, 10}, {1, 6, 10}, kLight), Sign::kPositive);
}

// The edge a → b runs along +y at (8, ·, 0); the disk spans x = -5 ... 5 at z = 10.
TEST(SideOfTangentPlane, NamesFollowTheDefinition) {
  const Vec3 a(8, 0, 0), b(8, 1, 0), contact_near(5, 0, 10), contact_far(-5, 0, 10);
  const bool near_is_first = orient3d(a, b, contact_near, kLight.center) == Sign::kPositive;
  ASSERT_NE(near_is_first, orient3d(a, b, contact_far, kLight.center) == Sign::kPositive);
  const Tangent near = near_is_first ? Tangent::kFirst : Tangent::kSecond;
  const Tangent far = near_is_first ? Tangent::kSecond : Tangent::kFirst;

  EXPECT_EQ(side_of_tangent_plane(a, b, {5, 3, 10}, near, kLight), Sign::kZero);
  EXPECT_EQ(side_of_tangent_plane(a, b, {5, 3, 10}, far, kLight), Sign::kPositive);
  EXPECT_EQ(side_of_tangent_plane(a, b, {-5, 3, 10}, far, kLight), Sign::kZero);
  EXPECT_EQ(side_of_tangent_plane(a, b, {0, 0, 10}, near, kLight), Sign::kPositive);
  EXPECT_EQ(side_of_tangent_plane(a, b, {8, 0, 5}, near, kLight), Sign::kNegative);  // beside the wedge
  EXPECT_EQ(side_of_tangent_plane(a, b, {8, 0, 5}, far, kLight), Sign::kPositive);
  EXPECT_EQ(side_of_tangent_plane(a, b, {16, 0, -10}, near, kLight),
            Sign::kNegative);  // mirror image of the disk
  EXPECT_EQ(side_of_tangent_plane(a, b, {16, 0, -10}, far, kLight), Sign::kNegative);
  EXPECT_EQ(side_of_tangent_plane(a, b, {8, 77, 0}, near, kLight), Sign::kZero);  // on the line
}

TEST(SideOfTangentPlane, LimitsOfCoincidingPlanes) {
  const DiskLight point{{0, 0, 10}, {0, 0, -1}, 0.0};
  const Vec3 a(8, 0, 0), b(8, 1, 0), q(8, 0, 5);
  const FaceClass expected = classify_face(a, b, q, point);
  ASSERT_NE(expected, FaceClass::kMixed);
  const Sign first = expected == FaceClass::kAllFront ? Sign::kNegative : Sign::kPositive;
  EXPECT_EQ(side_of_tangent_plane(a, b, q, Tangent::kFirst, point), first);
  EXPECT_EQ(side_of_tangent_plane(a, b, q, Tangent::kSecond, point),
            first == Sign::kPositive ? Sign::kNegative : Sign::kPositive);
  EXPECT_EQ(side_of_tangent_plane(a, b, {0, 0, 10}, Tangent::kFirst, point), Sign::kZero);

  // An edge in the light's plane: both planes are that plane.
  EXPECT_EQ(side_of_tangent_plane({8, 0, 10}, {8, 1, 10}, {99, 5, 10}, Tangent::kFirst, kLight), Sign::kZero);
  EXPECT_NE(side_of_tangent_plane({8, 0, 10}, {8, 1, 10}, {99, 5, 9}, Tangent::kFirst, kLight),
            side_of_tangent_plane({8, 0, 10}, {8, 1, 10}, {99, 5, 9}, Tangent::kSecond, kLight));
}

// A sun that shines along -z; its disk reaches 3/4 to the side at unit distance.
CircularLight sun(const Vec3& direction = {0, 0, -2}) {
  CircularLight light = DistantLight{direction, 0.0};
  light.radius = 0.75;
  return light;
}

TEST(DistantLight, IsTheLimitOfFarDisks) {
  const CircularLight light = DistantLight{{0, 0, -2}, 90.0};
  EXPECT_TRUE(light.is_distant());
  EXPECT_EQ(light.center, Vec3(0, 0, 2));
  EXPECT_NEAR(light.radius, 1.0, 1e-15);
  EXPECT_TRUE(std::isnan(CircularLight(DistantLight{{0, 0, -1}, 180.0}).radius));
  EXPECT_TRUE(std::isnan(CircularLight(DistantLight{{0, 0, -1}, -1e-9}).radius));
}

TEST(DistantLight, FacesSeeAllNoneOrPart) {
  for (const Vec3& a : {Vec3(0.0), Vec3(1e15, -1e15, 1e15)}) {
    EXPECT_EQ(classify_face(a, a + Vec3(1, 0, 0), a + Vec3(0, 1, 0), sun()), FaceClass::kAllFront);
    EXPECT_EQ(classify_face(a, a + Vec3(0, 1, 0), a + Vec3(1, 0, 0), sun()), FaceClass::kNoneFront);
    EXPECT_EQ(classify_face(a, a + Vec3(0, 1, 0), a + Vec3(0, 0, 1), sun()), FaceClass::kMixed);
    EXPECT_EQ(side_of_light_plane(a, sun()), Sign::kPositive);
  }
  EXPECT_EQ(classify_face({0, 0, 0}, {1, 1, 1}, {3, 3, 3}, sun()), FaceClass::kMixed);
}

TEST(DistantLight, TangencyIsMixedAndOneUlpDecides) {
  // The plane through the y axis and the rim's direction (3/4, 0, 1) touches the disk. A face in it that
  // falls off less steeply towards +x sees all of the disk.
  const auto face_to = [](double z, const Vec3& direction) {
    return classify_face({0, 0, 0}, {3, 0, z}, {0, 1, 0}, sun(direction));
  };
  for (const double length : {0x1p-300, 1.0, 3.0, 0x1p300}) {
    const Vec3 direction(0, 0, -length);
    EXPECT_EQ(face_to(4.0, direction), FaceClass::kMixed);
    EXPECT_EQ(face_to(std::nextafter(4.0, 5.0), direction), FaceClass::kMixed);
    EXPECT_EQ(face_to(std::nextafter(4.0, 3.0), direction), FaceClass::kAllFront);
    EXPECT_EQ(face_to(-4.0, direction), FaceClass::kMixed);
    EXPECT_EQ(face_to(std::nextafter(-4.0, -3.0), direction), FaceClass::kAllFront);
  }
}

TEST(DistantLight, AngleZeroIsADirection) {
  const CircularLight point = DistantLight{{0, 0, -1}, 0.0};
  EXPECT_EQ(classify_face({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, point), FaceClass::kAllFront);
  EXPECT_EQ(classify_face({0, 0, 0}, {0, 1, 0}, {0, 0, 1}, point), FaceClass::kMixed);  // edge-on
  EXPECT_EQ(line_outside_disk({1, 2, 3}, {1, 2, 4}, point), Sign::kZero);
  EXPECT_EQ(line_outside_disk({1, 2, 3}, {1, std::nextafter(2.0, 3.0), 4}, point), Sign::kPositive);
}

TEST(DistantLight, LinesCrossTouchMiss) {
  const Vec3 a(7, -3, 2);
  for (const double sign : {1.0, -1.0}) {
    EXPECT_EQ(line_outside_disk(a, a + sign * Vec3(0, 0, 1), sun()), Sign::kNegative);
    EXPECT_EQ(line_outside_disk(a, a + sign * Vec3(2.9, 0, 4), sun()), Sign::kNegative);
    EXPECT_EQ(line_outside_disk(a, a + sign * Vec3(3, 0, 4), sun()), Sign::kZero);
    EXPECT_EQ(line_outside_disk(a, a + sign * Vec3(3.1, 0, 4), sun()), Sign::kPositive);
    EXPECT_EQ(line_outside_disk(a, a + sign * Vec3(1, 1, 0), sun()), Sign::kPositive);
  }
}

// The edge runs along +y; the disk is seen between (-3/4, 1) and (3/4, 1) in x and z.
TEST(DistantLight, SidesOfTangentPlanes) {
  const Vec3 a(8, 0, 0), b(8, 1, 0), to_left(-3, 0, 4), to_right(3, 0, 4);
  // det(b - a, rim, center) as predicates.h has it
  const bool left_is_first = orient3d(Vec3(0.0), b - a, to_left, sun().center) == Sign::kPositive;
  const Tangent left = left_is_first ? Tangent::kFirst : Tangent::kSecond;
  const Tangent right = left_is_first ? Tangent::kSecond : Tangent::kFirst;
  EXPECT_EQ(side_of_tangent_plane(a, b, a + to_left, left, sun()), Sign::kZero);
  EXPECT_EQ(side_of_tangent_plane(a, b, a + to_left, right, sun()), Sign::kPositive);
  EXPECT_EQ(side_of_tangent_plane(a, b, a + to_right, right, sun()), Sign::kZero);
  EXPECT_EQ(side_of_tangent_plane(a, b, a + Vec3(0, 5, 1), left, sun()), Sign::kPositive);
  EXPECT_EQ(side_of_tangent_plane(a, b, a - Vec3(0, 5, 1), left, sun()), Sign::kNegative);
  EXPECT_EQ(side_of_tangent_plane(a, b, a - Vec3(0, 5, 1), right, sun()), Sign::kNegative);
  EXPECT_EQ(side_of_tangent_plane(a, b, a - Vec3(1, 0, 0), left, sun()), Sign::kNegative);
  EXPECT_EQ(side_of_tangent_plane(a, b, a - Vec3(1, 0, 0), right, sun()), Sign::kPositive);
  EXPECT_EQ(side_of_tangent_plane(a, b, {8, 77, 0}, right, sun()), Sign::kZero);  // on the line
}

TEST(Collinear, ExactlyAndNearly) {
  EXPECT_TRUE(detail::collinear({0, 0, 0}, {1, 2, 3}, {3, 6, 9}));
  EXPECT_TRUE(detail::collinear({1, 2, 3}, {1, 2, 3}, {5, 5, 5}));
  EXPECT_FALSE(detail::collinear({0, 0, 0}, {1, 2, 3}, {3, 6, std::nextafter(9.0, 10.0)}));
  EXPECT_FALSE(detail::collinear({0, 0, 0}, {1e-160, 0, 0}, {0, 1e-160, 0}));
}

TEST(Orient3d, SignAndScale) {
  for (const double s : {1e-150, 1e-100, 1.0, 1e100, 1e150}) {
    EXPECT_EQ(orient3d(Vec3(0.0), {s, 0, 0}, {0, s, 0}, {0, 0, s}), Sign::kPositive) << s;
    EXPECT_EQ(orient3d(Vec3(0.0), {0, s, 0}, {s, 0, 0}, {0, 0, s}), Sign::kNegative) << s;
    EXPECT_EQ(orient3d(Vec3(0.0), {s, 0, 0}, {0, s, 0}, {s, s, 0}), Sign::kZero) << s;
  }
}

}  // namespace
}  // namespace penumbra
