// Areas of convex polygons in the unit disk.
#include "render/soft_shadow_volumes/polygon_area.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "tests/render/render_support.h"

namespace penumbra::detail {
namespace {

using testing::kPi;
using testing::Random;

const Polygon kSquare{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};

TEST(PolygonArea, HoldsTheDiskOrLiesInIt) {
  EXPECT_NEAR(area_in_disk(kSquare), kPi, 1e-14);
  EXPECT_NEAR(area_in_disk({{-9, -7}, {5, -6}, {0, 8}}), kPi, 1e-14);
  EXPECT_NEAR(area_in_disk({{-0.1, -0.2}, {0.5, -0.2}, {0.2, 0.6}}), 0.24, 1e-14);
  EXPECT_NEAR(area_in_disk({{1.1, -5}, {6, -5}, {6, 5}, {1.1, 5}}), 0.0, 1e-14);
  EXPECT_NEAR(area_in_disk({{0, 0}, {5, 0}, {0, 5}}), kPi / 4.0, 1e-14) << "a quarter";
}

// A corner that is the center but for rounding has no direction that could be trusted.
TEST(PolygonArea, OfASliverIsNone) {
  for (const double angle : {0.0, 0.3, 0.7, 1.1})
    for (const double width : {0.0, 1e-17, 2e-15, 1e-12}) {
      const glm::dvec2 way(std::cos(angle), std::sin(angle)), across(-way.y, way.x);
      EXPECT_NEAR(area_in_disk({way, way + width * across, width * (across + 0.3 * way), {0, 0}}), 0.0, 2e-12)
          << angle << ", " << width;
    }
}

TEST(PolygonArea, IsThatBesideAChord) {
  for (double delta = -0.95; delta < 1.0; delta += 0.1) {
    Polygon part;
    const glm::dvec2 normal(0.6, -0.8);
    clip(kSquare, {normal, delta}, part);
    EXPECT_NEAR(area_in_disk(part), kPi * half_plane_area(delta), 1e-13) << delta;
  }
}

TEST(PolygonArea, OfBothPartsIsThatOfTheWhole) {
  Random random(11);
  for (int i = 0; i < 2'000; ++i) {
    const Chord line{random.unit2(), random.uniform(-1.3, 1.3)};
    Polygon one, other;
    clip(kSquare, line, one);
    clip(kSquare, {-line.normal, -line.delta}, other);
    EXPECT_NEAR(area_in_disk(one) + area_in_disk(other), kPi, 1e-12) << i;
  }
}

TEST(PolygonArea, LeftOfALine) {
  const Chord left = left_of({1, 1}, {3, 1});
  EXPECT_NEAR(glm::dot(left.normal, glm::dvec2(0, 5)) + left.delta, 4.0, 1e-15);
  EXPECT_NEAR(glm::distance(centroid_of({{0, 0}, {3, 0}, {0, 3}}), glm::dvec2(1, 1)), 0.0, 1e-15);
}

// Behind a segment there is what is left of the square behind its line, between the rays through its ends.
TEST(PolygonArea, BehindASegment) {
  Random random(12);
  for (int i = 0; i < 2'000; ++i) {
    const glm::dvec2 a(random.uniform(-2, 2), random.uniform(-2, 2)),
        b(random.uniform(-2, 2), random.uniform(-2, 2)), o(0.0);
    const bool left = cross(a, b) > 0.0;
    const glm::dvec2 first = left ? a : b, last = left ? b : a;
    Polygon one, two, three;
    clip(kSquare, left_of(o, first), one);
    clip(one, left_of(last, o), two);
    clip(two, left_of(last, first), three);
    EXPECT_NEAR(area_behind(a, b), (left ? 1.0 : -1.0) * area_in_disk(three), 1e-11) << i;
  }
  EXPECT_EQ(area_behind({2, -1}, {2, 1}), 0.0);
  EXPECT_NEAR(area_behind({0.2, -50}, {0.2, 50}), kPi * half_plane_area(-0.2), 1e-9);
}

}  // namespace
}  // namespace penumbra::detail
