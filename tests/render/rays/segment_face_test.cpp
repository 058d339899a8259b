// Which side of a face's plane a point lies on, and whether a face hides one point from another.
#include "render/rays/segment_face.h"

#include <gtest/gtest.h>

#include "tests/oracle/signs.h"
#include "tests/render/rays/ray_support.h"

namespace penumbra::detail {
namespace {

using penumbra::testing::Motion;
using penumbra::testing::Random;

bool hides(const FaceCorners& face, const Vec3& x, const Vec3& q) {
  return separates(face, x, q) && line_meets(face, x, q);
}

const FaceCorners kFace{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};

TEST(SideOfPlane, IsPositiveWhereTheFaceRunsCounterClockwise) {
  EXPECT_EQ(side_of_plane(kFace, {0.2, 0.2, 1}), 1);
  EXPECT_EQ(side_of_plane(kFace, {-5, 7, 1e-12}), 1);
  EXPECT_EQ(side_of_plane(kFace, {-5e11, 7e11, 1}), 1) << "far from the face";
  EXPECT_EQ(side_of_plane(kFace, {0.2, 0.2, -1}), -1);
  EXPECT_EQ(side_of_plane(kFace, {3, 4, 0}), 0);
  const FaceCorners none{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}};
  EXPECT_EQ(side_of_plane(none, {0, 0, 5}), 0) << "no area";
}

/// Points of a turned plane, rounded, lie in it. Some hundred roundings off they do not.
TEST(SideOfPlane, AllowsForRoundedCoordinates) {
  Random random(421);
  std::size_t off = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Motion motion = Motion::random(random);
    const double size = random.spread(1e-6, 1e6), height = 4e-14 * size;
    const auto place = [&](const Vec3& p) { return motion(p) * size; };
    const FaceCorners face{place(random.point()), place(random.point()), place(random.point())};
    const Vec3 n = glm::normalize(glm::cross(face.b - face.a, face.c - face.a));
    const Vec3 p =
        face.a + random.uniform(0.0, 1.0) * (face.b - face.a) + random.uniform(0.0, 1.0) * (face.c - face.a);
    const Vec3 in_plane = p - glm::dot(n, p - face.a) * n;
    ASSERT_EQ(side_of_plane(face, in_plane), 0) << i;
    off += side_of_plane(face, in_plane + height * n) > 0 && side_of_plane(face, in_plane - height * n) < 0;
  }
  EXPECT_GT(off, 19'000u) << "some faces are slivers";
}

/// The oracle moves coordinates by fewer roundings: what it takes for a point of the plane is one here, too;
/// and where both see a side, it is the same.
TEST(SideOfPlane, AgreesWithTheOracle) {
  Random random(422);
  std::size_t zeros = 0;
  for (int i = 0; i < 50'000; ++i) {
    const Motion motion = Motion::random(random);
    const FaceCorners face{motion(random.point()), motion(random.point()), motion(random.point())};
    const Vec3 n = glm::normalize(glm::cross(face.b - face.a, face.c - face.a));
    const Vec3 p =
        0.3 * face.a + 0.3 * face.b + 0.4 * face.c + random.uniform(-1, 1) * random.spread(1e-17, 1e-2) * n;
    const int mine = side_of_plane(face, p), theirs = oracle::side_of_face(p, {face.a, face.b, face.c});
    ASSERT_TRUE(mine == -theirs || mine == 0) << i;
    zeros += mine == 0;
  }
  EXPECT_GT(zeros, 1'000u);
  EXPECT_LT(zeros, 15'000u);
}

TEST(Hides, WhatLiesBetween) {
  EXPECT_TRUE(hides(kFace, {0.2, 0.2, -1}, {0.2, 0.2, 1}));
  EXPECT_TRUE(hides(kFace, {0.2, 0.2, 1}, {0.2, 0.2, -1})) << "from behind";
  EXPECT_TRUE(hides(kFace, {0.5, 0, -1}, {0.5, 0, 1})) << "at an edge";
  EXPECT_TRUE(hides(kFace, {0, 0, -1}, {0, 0, 1})) << "at a corner";
  EXPECT_FALSE(hides(kFace, {0.2, 0.2, 0.5}, {0.2, 0.2, 1})) << "behind the start";
  EXPECT_FALSE(hides(kFace, {0.2, 0.2, -1}, {0.2, 0.2, -0.5})) << "beyond the end";
  EXPECT_FALSE(hides(kFace, {0.8, 0.8, -1}, {0.8, 0.8, 1})) << "beside the ray";
  EXPECT_FALSE(hides(kFace, {0.2, 0.2, 0}, {0.2, 0.2, 1})) << "it starts on the face";
  EXPECT_FALSE(hides(kFace, {0.2, 0.2, -1}, {0.2, 0.2, 0})) << "it ends on the face";
  EXPECT_FALSE(hides(kFace, {-1, 0.2, 0}, {2, 0.2, 0})) << "it runs in the plane";
}

/// No segment slips between two faces at their common edge, or through a fan of them at their common corner.
TEST(Hides, NothingSlipsThroughASharedEdge) {
  Random random(423);
  for (int i = 0; i < 20'000; ++i) {
    const Motion motion = Motion::random(random);
    const Vec3 center = motion({0, 0, 0});
    std::vector<Vec3> ring;
    for (int k = 0; k < 5; ++k)
      ring.push_back(motion({std::cos(1.2566 * k), std::sin(1.2566 * k), random.uniform(-0.2, 0.2)}));
    const Vec3 near = center + random.uniform(0.0, 0.5) * (ring[0] - center);  // on an edge, rounded
    const Vec3 x = near + motion.turned({random.uniform(-1, 1), random.uniform(-1, 1), 3.0}),
               q = near + (near - x);
    int count = 0;
    for (int k = 0; k < 5; ++k) count += hides({center, ring[k], ring[(k + 1) % 5]}, x, q);
    ASSERT_GE(count, 1) << i;
  }
}

}  // namespace
}  // namespace penumbra::detail
