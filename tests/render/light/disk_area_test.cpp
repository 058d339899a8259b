#include "render/light/disk_area.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "render/light/arc_sine.h"

namespace penumbra {
namespace {

constexpr double kPi = std::numbers::pi;

TEST(ArcSine, IsThatOfTheLibrary) {
  double worst = 0.0;
  for (int i = -200'000; i <= 200'000; ++i)
    worst = std::max(worst, std::abs(detail::arc_sine(i / 200'000.0) - std::asin(i / 200'000.0)));
  for (const double x : {0.5, -0.5, std::nextafter(0.5, 1.0), 1e-300, std::nextafter(1.0, 0.0)})
    worst = std::max(worst, std::abs(detail::arc_sine(x) - std::asin(x)));
  EXPECT_LE(worst, 5e-16);
}

TEST(ChordOfPlane, OfAnEdgeParallelToTheLight) {
  // The plane through the receiver on the axis and the line x = 0.25 at half its depth meets the light in x =
  // 0.5.
  const Vec3 x{0, 0, 4}, a{0.25, 1, 2}, b{0.25, -1, 2};
  const Chord chord = chord_of_plane(edge_plane(x, a, b), x, 2.0);
  EXPECT_NEAR(std::abs(chord.delta), 0.25, 1e-15);
  EXPECT_NEAR(std::abs(chord.normal.x), 1.0, 1e-15);
  // The center's side is the positive one.
  EXPECT_GT(chord.delta * glm::dot(edge_plane(x, a, b), -x), 0.0);
}

TEST(ChordOfPlane, TurnsOverWithTheEdge) {
  const Vec3 x{0.3, -0.2, 4}, a{0.25, 1, 2}, b{-0.5, -1, 1};
  const Chord one = chord_of_plane(edge_plane(x, a, b), x, 2.0);
  const Chord two = chord_of_plane(edge_plane(x, b, a), x, 2.0);
  EXPECT_NEAR(one.delta, -two.delta, 1e-15);
  EXPECT_NEAR(one.normal.x, -two.normal.x, 1e-15);
  EXPECT_NEAR(one.normal.y, -two.normal.y, 1e-15);
}

TEST(ChordOfPlane, ParallelToTheDiskIsAllOrNothing) {
  EXPECT_EQ(chord_of_plane({0, 0, -1}, {0, 0, 3}, 0.5).delta, std::numeric_limits<double>::infinity());
  EXPECT_EQ(chord_of_plane({0, 0, 1}, {0, 0, 3}, 0.5).delta, -std::numeric_limits<double>::infinity());
}

TEST(HalfPlaneArea, KnownValues) {
  EXPECT_EQ(half_plane_area(-1.0), 0.0);
  EXPECT_EQ(half_plane_area(-7.0), 0.0);
  EXPECT_EQ(half_plane_area(1.0), 1.0);
  EXPECT_EQ(half_plane_area(std::numeric_limits<double>::infinity()), 1.0);
  EXPECT_DOUBLE_EQ(half_plane_area(0.0), 0.5);
  // At δ = 1/2 a segment of half angle 60° is cut off: (π/3 - √3/4)/π.
  EXPECT_NEAR(half_plane_area(0.5), 1.0 - (1.0 / 3 - std::sqrt(3.0) / (4 * kPi)), 1e-15);
}

TEST(TwoHalfPlanesArea, OfPerpendicularDiametersIsAQuarter) {
  EXPECT_NEAR(two_half_planes_area({{1, 0}, 0.0}, {{0, 1}, 0.0}), 0.25, 1e-15);
}

TEST(TwoHalfPlanesArea, OfTwoDiametersIsTheAngleBetweenThem) {
  for (const double angle : {0.0, 0.1, 1.0, 2.0, 3.0, kPi}) {
    EXPECT_NEAR(two_half_planes_area({{1, 0}, 0.0}, {{std::cos(angle), std::sin(angle)}, 0.0}),
                (kPi - angle) / (2 * kPi), 1e-15)
        << angle;
  }
}

TEST(TwoHalfPlanesArea, ParallelKeepsTheSmallerAntiparallelTheStrip) {
  const double small = half_plane_area(-0.3), large = half_plane_area(0.6);
  EXPECT_NEAR(two_half_planes_area({{0.6, 0.8}, -0.3}, {{0.6, 0.8}, 0.6}), small, 1e-15);
  EXPECT_NEAR(two_half_planes_area({{0.6, 0.8}, 0.3}, {{-0.6, -0.8}, 0.6}),
              half_plane_area(0.3) + large - 1.0, 1e-15);
  EXPECT_NEAR(two_half_planes_area({{0.6, 0.8}, -0.3}, {{-0.6, -0.8}, 0.3}), 0.0, 1e-15);
  EXPECT_NEAR(two_half_planes_area({{0.6, 0.8}, -0.5}, {{-0.6, -0.8}, 0.2}), 0.0, 1e-15);
}

TEST(TwoHalfPlanesArea, AHalfPlaneThatHoldsTheDiskLeavesTheOther) {
  for (const double delta : {1.0, 1.5, std::numeric_limits<double>::infinity()}) {
    EXPECT_EQ(two_half_planes_area({{1, 0}, delta}, {{0, 1}, 0.4}), half_plane_area(0.4));
    EXPECT_EQ(two_half_planes_area({{0, 1}, 0.4}, {{1, 0}, delta}), half_plane_area(0.4));
    EXPECT_EQ(two_half_planes_area({{0, 1}, 0.4}, {{1, 0}, -delta}), 0.0);
  }
}

}  // namespace
}  // namespace penumbra
