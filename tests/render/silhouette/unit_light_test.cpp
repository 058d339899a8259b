// The frame of the light against the world: where points of the disk go, what a receiver sees, and sides of
// planes.
#include "render/silhouette/edges/unit_light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "tests/render/random_poses.h"

namespace penumbra::detail {
namespace {

using penumbra::testing::Random;

/// A light whose disk fills about `angle` radians from the origin, `distance` away; infinite: a distant
/// light.
CircularLight light_at(const Vec3& direction, double distance, double angle) {
  if (std::isinf(distance))
    return DistantLight{.direction = direction,
                        .angle_degrees = 2.0 * std::atan(angle) * 180.0 / std::numbers::pi};
  return DiskLight{-distance * glm::normalize(direction), direction, angle * distance};
}

/// Where x sees p on the unit disk, by the world's coordinates (design: a - k d_uv / d_w).
glm::dvec2 seen_at(const UnitLight& light, const Vec3& x, const Vec3& p) {
  const CircularLight& of = light.light();
  const Vec3 d = light.direction(p - x);
  if (of.is_distant()) return -glm::dvec2(d) / (of.radius * d.z);
  const Vec3 from_center = light.direction(x - of.center);
  return (glm::dvec2(from_center) - glm::dvec2(d) * (from_center.z / d.z)) / of.radius;
}

/// Projection onto z = 0 in the light's frame.
glm::dvec2 projected(const Vec3& x, const Vec3& p) {
  return glm::dvec2(x) + (glm::dvec2(p) - glm::dvec2(x)) * (x.z / (x.z - p.z));
}

const double kDistances[] = {5.0, 20.0, 1e2, 1e4, 1e8, 1e12, std::numeric_limits<double>::infinity()};

TEST(UnitLight, ReceiversSeeWhatTheySeeInTheWorld) {
  Random random(11);
  for (const double distance : kDistances)
    for (int round = 0; round < 300; ++round) {
      const Vec3 direction = random.direction() + 0.2 * random.point();
      const UnitLight light(light_at(direction, distance, random.spread(1e-3, 0.3)),
                            Bounds{Vec3(-1.0), Vec3(1.0)});
      const Vec3 x = 0.7 * random.point(), step = random.point();
      const Vec3 p = x - (glm::dot(step, direction) > 0.0 ? step : -step) * 0.3;
      const glm::dvec2 expected = seen_at(light, x, p), got = projected(light.point(x), light.point(p));
      // Of a far disk the expected value has lost the digits of its distance.
      const double most = std::isinf(distance) ? 1e-11 : 1e-13 * distance;
      EXPECT_LE(glm::distance(expected, got), most * (1.0 + glm::length(expected)) * 1e2)
          << "distance " << distance;
    }
}

TEST(UnitLight, PlanesKeepTheirSides) {
  Random random(12);
  for (const double distance : kDistances)
    for (int round = 0; round < 300; ++round) {
      const Vec3 direction = random.direction();
      const UnitLight light(light_at(direction, distance, random.spread(1e-3, 0.3)),
                            Bounds{Vec3(-1.0), Vec3(1.0)});
      const Vec3 x = 0.9 * random.point(), n = random.direction(), at = light.point(x);
      const Vec3 normal = light.plane_normal(x, n);
      EXPECT_NEAR(glm::length(normal), 1.0, 1e-12);
      const UnitLight::Plane back = light.world_plane(normal, -glm::dot(normal, at));
      for (int i = 0; i < 20; ++i) {
        const Vec3 p = 0.9 * random.point();
        const double side = glm::dot(n, p - x);
        if (std::abs(side) < 1e-3) continue;
        EXPECT_GT(glm::dot(normal, light.point(p) - at) * side, 0.0);
        EXPECT_GT((glm::dot(back.normal, p - light.origin()) + back.offset) * side, 0.0);
      }
    }
}

TEST(UnitLight, FarLightsTendToTheDistantOne) {
  Random random(13);
  for (int round = 0; round < 100; ++round) {
    const Vec3 direction = random.direction(), p = random.point();
    const double angle = random.spread(1e-3, 0.3);
    const Bounds box{Vec3(-1.0), Vec3(1.0)};
    const Vec3 limit = UnitLight(light_at(direction, kDistances[6], angle), box).point(p);
    double before = 1.0;
    for (const double distance : {1e2, 1e4, 1e6, 1e8}) {
      const double off =
          glm::distance(UnitLight(light_at(direction, distance, angle), box).point(p), limit) * angle;
      EXPECT_LE(off, 40.0 / distance);
      EXPECT_LE(off, before);
      before = off;
    }
  }
}

TEST(UnitLight, KeepsDigitsAtAnyDistance) {
  const Bounds box{Vec3(-1.0), Vec3(1.0)};
  for (const double distance : {1e3, 1e6, 1e9, 1e12}) {
    const UnitLight light(light_at({0.3, -1.0, 0.2}, distance, 0.005), box);
    const Vec3 p{0.25, 0.5, -0.125}, q = p + Vec3(0x1p-40, 0, 0);
    const double moved = glm::distance(light.point(p), light.point(q)) * 0.005;
    EXPECT_NEAR(moved / 0x1p-40, 0.33, 0.2) << distance;
  }
}

}  // namespace
}  // namespace penumbra::detail
