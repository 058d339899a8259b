// Planes between a light's receivers and a caster: what is separated is never met by a segment, and what is
// clearly apart is separated.
#include "render/plan/light_sides.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "tests/render/render_support.h"

namespace penumbra {
namespace {

using detail::LightSides;
using testing::Random;

Bounds box_about(const Vec3& middle, const Vec3& half) {
  Bounds box;
  box.add(middle - glm::abs(half));
  box.add(middle + glm::abs(half));
  return box;
}

Vec3 point_in(const Bounds& box, Random& random) {
  Vec3 p;
  for (int k = 0; k < 3; ++k)
    p[k] = random.uniform(0.0, 1.0) < 0.5 ? (random.uniform(0.0, 1.0) < 0.5 ? box.low[k] : box.high[k])
                                          : random.uniform(box.low[k], box.high[k]);
  return p;
}

/// A way from x to a point of the light, the rim more often than not.
Vec3 way_to_light(const CircularLight& light, const Vec3& x, Random& random) {
  const LightFrame frame = light_frame(light);
  const double far = std::min(1.0, random.uniform(0.0, 2.0));
  const glm::dvec2 at = light.radius * far * random.unit2();
  return way_to_center(light, x) + at.x * frame.u + at.y * frame.v;
}

/// Whether the segment (or the ray) meets the box.
bool meets(const Bounds& box, const Vec3& x, const Vec3& way, bool endless) {
  double first = 0.0, last = endless ? 1e300 : 1.0;
  for (int k = 0; k < 3; ++k) {
    if (way[k] == 0.0) {
      if (x[k] < box.low[k] || x[k] > box.high[k]) return false;
      continue;
    }
    const double a = (box.low[k] - x[k]) / way[k], b = (box.high[k] - x[k]) / way[k];
    first = std::max(first, std::min(a, b));
    last = std::min(last, std::max(a, b));
  }
  return first <= last;
}

CircularLight random_light(Random& random) {
  if (random.uniform(0.0, 1.0) < 0.3) return DistantLight{random.direction(), random.spread(0.01, 60.0)};
  return {random.point(4.0), random.direction(), random.spread(1e-3, 3.0)};
}

/// A light, and a box of receivers that is not behind it.
struct Case {
  explicit Case(Random& random) : light(random_light(random)) {
    do {
      light = random_light(random);
      receivers = box_about(random.point(3.0), random.spread(1e-6, 1.0) * random.point());
    } while (is_behind(light, receivers.low) || is_behind(light, receivers.high));
  }
  CircularLight light;
  Bounds receivers;
};

TEST(LightSidesProperty, WhatIsSeparatedIsNeverMet) {
  std::size_t separated = 0;
  for (std::uint64_t seed = 1; seed <= 20'000; ++seed) {
    Random random(seed);
    const Case c(random);
    const Bounds caster = box_about(random.point(3.0), random.spread(1e-3, 2.0) * random.point());
    if (!LightSides(c.light).separates(c.receivers, caster)) continue;
    ++separated;
    for (int i = 0; i < 100; ++i) {
      const Vec3 x = point_in(c.receivers, random);
      if (is_behind(c.light, x)) continue;
      ASSERT_FALSE(meets(caster, x, way_to_light(c.light, x, random), c.light.is_distant()))
          << "seed " << seed;
    }
  }
  EXPECT_GT(separated, 10'000u);
}

// A corner of the caster's box lies on a segment from a receiver to the rim, by as little as double can tell.
TEST(LightSidesProperty, WhatOnlyJustReachesIsNotSeparated) {
  for (std::uint64_t seed = 1; seed <= 20'000; ++seed) {
    Random random(seed);
    const Case c(random);
    const Vec3 x = point_in(c.receivers, random);
    if (is_behind(c.light, x)) continue;
    const LightFrame frame = light_frame(c.light);
    const glm::dvec2 at = c.light.radius * random.unit2();
    const Vec3 way = way_to_center(c.light, x) + at.x * frame.u + at.y * frame.v;
    const Vec3 corner = x + random.uniform(1e-3, c.light.is_distant() ? 5.0 : 0.999) * way;
    Bounds caster;
    caster.add(corner);
    caster.add(corner + random.point());
    EXPECT_FALSE(LightSides(c.light).separates(c.receivers, caster)) << "seed " << seed;
    EXPECT_FALSE(LightSides(c.light).separates({x, x}, caster)) << "seed " << seed;
  }
}

// Of one receiver the sides lie within two percent of the cone.
TEST(LightSidesProperty, WhatIsClearlyBesideTheConeIsSeparated) {
  for (std::uint64_t seed = 1; seed <= 5'000; ++seed) {
    Random random(seed);
    const CircularLight light(Vec3(0, 5, 0), Vec3(0, -1, 0), random.uniform(0.1, 2.0));
    const Vec3 x{random.uniform(-3.0, 3.0), random.uniform(-2.0, 0.0), random.uniform(-3.0, 3.0)};
    const double t = random.uniform(0.1, 0.9), half = random.uniform(0.0, 0.1);
    const glm::dvec2 beside = (1.03 * t * light.radius + 1.5 * half) * random.unit2();
    const Vec3 middle = x + t * (light.center - x) + Vec3(beside.x, 0.0, beside.y);
    EXPECT_TRUE(LightSides(light).separates({x, x}, box_about(middle, Vec3(half, 0.0, half)))) << seed;
  }
}

TEST(LightSides, DarkIsBehindTheLightOrFacingAway) {
  const LightSides sides(CircularLight(Vec3(0, 2, 0), Vec3(0, -1, 0), 1.0));
  const auto dark = [&](const Vec3& x, const Vec3& normal, bool horizon = true) {
    return sides.is_dark({.points = {x, x}, .normals = {normal, normal}, .count = 1}, horizon);
  };
  EXPECT_FALSE(dark({0, 0, 0}, {0, 1, 0}));
  EXPECT_TRUE(dark({0, 0, 0}, {0, -1, 0}));
  EXPECT_FALSE(dark({0, 0, 0}, {0, -1, 0}, false)) << "O has no horizon";
  EXPECT_TRUE(dark({0, 3, 0}, {0, 1, 0}, false));
  EXPECT_FALSE(dark({0.9, 0, 0}, {1, 0, 0})) << "a part of the disk is beyond it";
  EXPECT_TRUE(dark({1.1, 0, 0}, {1, 0, 0}));
}

}  // namespace
}  // namespace penumbra
