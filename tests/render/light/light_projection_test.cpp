#include "render/light/light_projection.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/render/render_support.h"

namespace penumbra {
namespace {

using testing::Random;

LightProjection projection_of(const LightShape& light, const Vec3& middle, double least_depth = 1e-3) {
  return LightProjection(area_light(light), middle, least_depth);
}

/// (q, h).
Vec3 placed(const LightProjection& projection, const Vec3& world) {
  const Vec3 p = projection.local(world);
  return Vec3(projection.place(p), -p.z) / projection.weight(p);
}

/// The disk of a distant light's angle, `distance` away from the origin.
DiskLight disk_at(const DistantLight& light, double distance) {
  const Vec3 m = glm::normalize(light.direction);
  return {-distance * m, m, distance * CircularLight(light).radius};
}

// From a receiver the way to a point of the light goes along (spread · d, 1), wherever the light is.
TEST(LightProjection, EveryLightIsADistantOne) {
  Random random(5);
  for (int k = 0; k < 2'000; ++k) {
    const double distance = random.spread(1.0, 1e9);
    const Vec3 middle = random.point(100.0), m = random.direction();
    const DiskLight light{middle - distance * m + random.point(0.3 * distance), random.uniform(0.2, 3.0) * m,
                          random.spread(1e-3, 1.0) * distance};
    const LightProjection projection = projection_of(light, middle);
    const Vec3 x = middle + random.point();
    if (projection.weight(projection.local(x)) < 0.1) continue;
    const glm::dvec2 d = random.uniform(0.0, 1.0) * random.unit2();
    const LightFrame axes = light_frame(light);
    const Vec3 rim = light.center + light.radius * (d.x * axes.u + d.y * axes.v);
    const Vec3 at = placed(projection, x),
               up = placed(projection, x + random.uniform(0.1, 0.5) / distance * (rim - x)) - at;
    // Rounding: rim - x is known to 1e-16 of the distance, and the way is at least a tenth long.
    EXPECT_NEAR(up.x / up.z, projection.spread().x * d.x, 1e-12 * (1.0 + glm::length(projection.tilt())));
    EXPECT_NEAR(up.y / up.z, projection.spread().y * d.y, 1e-12 * (1.0 + glm::length(projection.tilt())));
    EXPECT_GT(up.z, 0.0);
  }
}

TEST(LightProjection, FarDisksConvergeToTheDistantLight) {
  Random random(6);
  const DistantLight sun{{0.3, -1.0, 0.2}, 0.53};
  const LightProjection limit = projection_of(sun, Vec3(0.0));
  for (int k = 0; k < 100; ++k) {
    const Vec3 p = random.point();
    for (const double distance : {1e2, 1e4, 1e8, 1e11}) {
      const LightProjection near = projection_of(disk_at(sun, distance), Vec3(0.0));
      EXPECT_LT(glm::length(placed(near, p) - placed(limit, p)), 8.0 / distance + 1e-15);
      EXPECT_LT(glm::length(near.spread() - limit.spread()), 1e-14);
    }
  }
}

// What (q, h) says of heights above a plane is what the world says.
TEST(LightProjection, PlanesStayPlanes) {
  Random random(7);
  const DiskLight near{{3.0, 4.0, 1.0}, {-1.0, -2.0, 0.3}, 0.5};
  const DistantLight sun{{0.3, -1.0, 0.2}, 0.53};
  for (const LightShape& light : {LightShape(near), LightShape(sun)}) {
    const LightProjection projection = projection_of(light, {0.1, 0.2, 0.3});
    for (int k = 0; k < 1'000; ++k) {
      const Vec3 x = random.point(), p = random.point(), n = random.direction();
      const double weight = projection.weight(projection.local(p));
      ASSERT_GT(weight, 0.0);
      const double height =
          glm::dot(projection.plane(n, x), placed(projection, p) - placed(projection, x)) * weight;
      EXPECT_NEAR(height, glm::dot(n, p - x), 1e-13);
    }
  }
}

// The world's coordinates may be large and the light far: what is near the origin keeps its digits.
TEST(LightProjection, KeepsDigitsFarFromTheWorldsOriginAndFromTheLight) {
  Random random(8);
  const Vec3 away(0x1p40, -0x1p39, 0x1p38);
  for (const double distance : {10.0, 1e5, 1e10}) {
    const DiskLight light{{-distance, distance, 0.0}, {1.0, -1.0, 0.0}, 0.02 * distance};
    DiskLight moved = light;
    moved.center += away;
    const LightProjection here = projection_of(light, Vec3(0.0)), there = projection_of(moved, away);
    for (int k = 0; k < 100; ++k) {
      const Vec3 p =
          glm::round(1024.0 * random.point()) / 1024.0;  // what is added to `away` without rounding
      const Vec3 difference = placed(here, p) - placed(there, away + p);
      EXPECT_LT(glm::length(difference), 1e-3 / distance * 1e-1 + 1e-13) << distance;
    }
  }
}

TEST(LightProjection, TheOriginIsInFrontOfTheLight) {
  const DiskLight light{{0.0, 5.0, 0.0}, {0.0, -1.0, 0.0}, 1.0};
  for (const double height : {4.0, 5.0, 9.0}) {
    const LightProjection projection = projection_of(light, {2.0, height, 1.0}, 0.25);
    EXPECT_EQ(1.0 / projection.nearness(), std::max(5.0 - height, 0.25));
    EXPECT_EQ(projection.weight(projection.local({7.0, 5.0, 7.0})), 0.0);
    EXPECT_LT(projection.weight(projection.local({7.0, 6.0, 7.0})), 0.0);
  }
}

}  // namespace
}  // namespace penumbra
