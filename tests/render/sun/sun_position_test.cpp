// The sun's position against values that others have published or computed.
#include "penumbra/render/sun/sun_position.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "penumbra/mesh/error.h"

namespace penumbra {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

Vec3 towards(double azimuth, double elevation) {
  return {std::cos(elevation * kDegree) * std::sin(azimuth * kDegree),
          std::cos(elevation * kDegree) * std::cos(azimuth * kDegree), std::sin(elevation * kDegree)};
}

/// Of two directions by azimuth and elevation, seconds of arc.
double seconds_between(const Vec3& a, const Vec3& b) {
  return 2.0 * std::asin(0.5 * glm::length(a - b)) / kDegree * 3600.0;
}

// I. Reda, A. Andreas, "Solar Position Algorithm for Solar Radiation Applications", NREL/TP-560-34302 (2008),
// appendix A.5: 17 October 2003, 12:30:30, 7 hours behind UTC. The observer's height, 1,830 m, changes the
// parallax by .003".
TEST(SunPosition, ExampleOfTheSolarPositionAlgorithm) {
  const SunPosition sun = sun_position(1066419030.0, {.latitude = 39.742476,
                                                      .longitude = -105.1786,
                                                      .pressure = 820.0,
                                                      .temperature = 11.0,
                                                      .delta_t = 67.0});
  EXPECT_NEAR(90.0 - sun.elevation, 50.11162, 2e-4);  // .5", of the 5.5" that are promised
  EXPECT_NEAR(sun.azimuth, 194.34024, 1e-3);
  EXPECT_NEAR(sun.distance, 0.9965422974, 2e-5);
}

struct Known {
  double unix_time, latitude, longitude, azimuth, elevation, distance;
};

// By ERFA 2.0, the IAU's routines: eraEpv00 with aberration, eraC2t06a, without refraction.
TEST(SunPosition, SixSecondsOfArcFromTheRoutinesOfTheIau) {
  constexpr Known kKnown[] = {
      {-1385661000.0, 12.0, 77.0, 154.03078, 58.12357, 0.985691},           // 1926-02-03T06:10:00Z
      {186594330.0, -33.9, 18.4, 257.89977, 21.75535, 0.986205},            // 1975-11-30T15:45:30Z
      {1066419030.0, 39.742476, -105.1786, 194.34017, 39.87206, 0.996542},  // 2003-10-17T19:30:30Z
      {1782043200.0, 52.5, 13.4, 203.74438, 59.30380, 1.016203},            // 2026-06-21T12:00:00Z
      {1797843600.0, 69.6, 18.9, 156.55505, -4.84219, 0.983767},            // 2026-12-21T09:00:00Z
      {3793734900.0, -77.8, 166.7, 26.81942, 10.58464, 0.995809}};          // 2090-03-20T23:15:00Z
  for (const Known& known : kKnown) {
    const SunPosition sun = sun_position(
        known.unix_time, {.latitude = known.latitude, .longitude = known.longitude, .pressure = 0.0});
    EXPECT_LT(seconds_between(towards(sun.azimuth, sun.elevation), towards(known.azimuth, known.elevation)),
              6.0)
        << known.unix_time;
    EXPECT_NEAR(sun.distance, known.distance, 3e-5);
    EXPECT_NEAR(sun.radius * sun.distance, 959.63 / 3600.0, 1e-9);
  }
}

TEST(SunPosition, MovesWithoutJumps) {
  const SunSite site{.latitude = 60.0, .longitude = 25.0};
  SunPosition before = sun_position(1.75e9, site);
  for (int minute = 1; minute < 3 * 24 * 60; ++minute) {
    const SunPosition sun = sun_position(1.75e9 + 60.0 * minute, site);
    EXPECT_LT(seconds_between(towards(before.azimuth, before.elevation), towards(sun.azimuth, sun.elevation)),
              60.0 * 15.1 * 1.25);  // refraction stretches the last degree
    before = sun;
  }
}

// Refraction at the horizon is about 34', after Sæmundsson 29' for a geometric elevation of 0.
TEST(SunPosition, AirRaisesALowSun) {
  const double night = 1797843600.0;
  SunSite site{.latitude = 66.0, .longitude = 18.9, .pressure = 0.0};
  const double bare = sun_position(night, site).elevation;
  ASSERT_NEAR(bare, 0.0, 2.0);
  site.pressure = 1010.0;
  EXPECT_GT(sun_position(night, site).elevation, bare + 0.3);
  EXPECT_LT(sun_position(night, site).elevation, bare + 0.7);
}

TEST(SunLight, ShinesAlongTheAxesOfTheScene) {
  const double r = 0.25;
  const auto near = [](const Vec3& a, const Vec3& b) { return glm::length(a - b) < 1e-12; };
  const SceneAxes y_up, z_up{{0, 0, 2}, {0, 3, 1}};
  EXPECT_TRUE(near(sun_light({90.0, 0.0, r}, y_up).direction, {-1, 0, 0}));  // from the east, +x
  EXPECT_TRUE(near(sun_light({180.0, 0.0, r}, y_up).direction, {0, 0, -1}));
  EXPECT_TRUE(near(sun_light({10.0, 90.0, r}, y_up).direction, {0, -1, 0}));
  EXPECT_TRUE(near(sun_light({90.0, 0.0, r}, z_up).direction, {-1, 0, 0}));
  EXPECT_TRUE(near(sun_light({0.0, 0.0, r}, z_up).direction, {0, -1, 0}));
  EXPECT_EQ(sun_light({0.0, 0.0, r}, z_up).angle_degrees, 0.5);
}

TEST(SunLight, RefusesWhatIsNoPlaceAndNoAxes) {
  EXPECT_THROW(sun_position(0.0, {.latitude = 91.0}), UsageError);
  EXPECT_THROW(sun_position(0.0, {.longitude = 361.0}), UsageError);
  EXPECT_THROW(sun_position(0.0, {.temperature = -300.0}), UsageError);
  EXPECT_THROW(sun_position(NAN, {}), UsageError);
  EXPECT_THROW(sun_light({}, {{0, 1, 0}, {0, -2, 0}}), UsageError);
  EXPECT_THROW(sun_light({}, {{0, 0, 0}, {0, 0, 1}}), UsageError);
}

}  // namespace
}  // namespace penumbra
