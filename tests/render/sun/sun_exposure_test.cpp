// The sun over time: contacts against rays in double (tests/oracle), sunrise against the sun's elevation,
// arrays of lights.
#include "penumbra/render/sun/sun_exposure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "penumbra/mesh/error.h"
#include "penumbra/mesh/shapes.h"
#include "tests/oracle/oracle.h"

namespace penumbra {
namespace {

constexpr double kMorning = 1782010800.0;  // 2026-06-21T03:00Z
constexpr double kHour = 3600.0;
const SunSky kBerlin{{.latitude = 52.5, .longitude = 13.4}, {}};

/// Three houses and a tower, meters, y up, north -z.
std::vector<TriangleMesh> town() {
  return {make_box({-9, 4, -4}, {5, 4, 3}), make_box({6, 6, 2}, {4, 6, 5}),
          make_box({-3, 10, 14}, {2, 10, 2}), make_box({0, 3, -14}, {12, 3, 2})};
}

struct Ground {
  std::vector<Vec3> points{{0, 0, 0}, {-3, 0, 5}, {1.3, 0.5, -7}, {11, 0, -4}};
  std::vector<Vec3> normals{points.size(), Vec3(0, 1, 0)};
  Receivers receivers() const { return {.points = points, .normals = normals}; }
};

std::vector<SunContact> contacts_of_a_day(SunExposure& sun, double step) {
  std::vector<SunContact> all;
  const double night = kMorning - 2.0 * kHour;
  std::vector<float> before = sun.seen(night);
  for (double t = night; t < night + 20.0 * kHour; t += step) {
    const std::vector<float> after = sun.seen(t + step);
    const auto more = sun.contacts(t, before, t + step, after);
    all.insert(all.end(), more.begin(), more.end());
    before = after;
  }
  return all;
}

/// The share of the sun's disk above the ground that the oracle finds unhidden: 16,384 rays, of which 20 are
/// within a second's way of the limb.
double oracle_seen(const oracle::Oracle& oracle, const Vec3& point, double time) {
  return oracle.visibility(point, {0, 1, 0}, {}, sun_light(sun_position(time, kBerlin.site), kBerlin.axes),
                           16384, 7);
}

void expect_within_a_second(const oracle::Oracle& oracle, const Vec3& point, const SunContact& contact) {
  const double before = oracle_seen(oracle, point, contact.time - 1.0);
  const double after = oracle_seen(oracle, point, contact.time + 1.0);
  switch (contact.kind) {
    case SunContactKind::kFirstLight:
      EXPECT_EQ(before, 0.0);
      EXPECT_GT(after, 0.0);
      break;
    case SunContactKind::kFullLight:
      EXPECT_LT(before, 1.0);
      EXPECT_EQ(after, 1.0);
      break;
    case SunContactKind::kFirstShade:
      EXPECT_EQ(before, 1.0);
      EXPECT_LT(after, 1.0);
      break;
    case SunContactKind::kLastLight:
      EXPECT_GT(before, 0.0);
      EXPECT_EQ(after, 0.0);
      break;
  }
}

TEST(SunExposure, ContactsAreWithinASecondOfTheOracles) {
  const std::vector<TriangleMesh> casters = town();
  const oracle::Oracle oracle(casters);
  const Casters prepared(casters);
  const Ground ground;
  SunExposure sun(prepared, ground.receivers(), kBerlin);
  const std::vector<SunContact> contacts = contacts_of_a_day(sun, 600.0);
  std::vector<int> kinds(4, 0);
  for (const SunContact& contact : contacts) {
    SCOPED_TRACE(std::string(name_of(contact.kind)) + " of receiver " + std::to_string(contact.receiver) +
                 " at " + std::to_string(contact.time));
    expect_within_a_second(oracle, ground.points[contact.receiver], contact);
    ++kinds[static_cast<std::size_t>(contact.kind)];
  }
  EXPECT_GE(*std::ranges::min_element(kinds), 4) << "the town hides too little to test anything";
  EXPECT_GT(sun.counts().nights, 0u);
}

TEST(SunExposure, SunriseIsWhenTheLimbCrossesTheHorizon) {
  const std::vector<TriangleMesh> casters = {
      make_box({0, -5, 0}, {1, 1, 1})};  // below the ground: hides nothing
  const Casters prepared(casters);
  const std::vector<Vec3> points{{0, 1, 0}};
  SunExposure sun(prepared, {.points = points}, kBerlin);
  const std::vector<SunContact> contacts = contacts_of_a_day(sun, 600.0);
  ASSERT_EQ(contacts.size(), 4u);
  for (const SunContact& contact : contacts) {
    const SunPosition at = sun_position(contact.time, kBerlin.site);
    const bool whole =
        contact.kind == SunContactKind::kFullLight || contact.kind == SunContactKind::kFirstShade;
    // The elevation changes by .0024 degrees a second here.
    EXPECT_NEAR(at.elevation, whole ? at.radius : -at.radius, 0.0024) << name_of(contact.kind);
  }
}

TEST(SunExposure, DarkAtNightAndContinuousAtSunrise) {
  const std::vector<TriangleMesh> casters = town();
  const Casters prepared(casters);
  // On a wall that looks east, on the ground, and without a normal.
  const std::vector<Vec3> points{{20, 2, 0}, {20, 0, 0}, {0, 30, 0}};
  const std::vector<Vec3> normals{{1, 0, 0}, {0, 1, 0}, glm::normalize(Vec3(1, 1, -1))};
  SunExposure sun(prepared, {.points = points, .normals = normals}, kBerlin);
  EXPECT_EQ(sun.seen(kMorning - 3.0 * kHour), std::vector<float>(3, 0.0f));
  std::vector<float> before = sun.seen(kMorning - 0.75 * kHour);
  EXPECT_EQ(before, std::vector<float>(3, 0.0f));
  for (double t = kMorning - 0.75 * kHour + 4.0; t < kMorning; t += 4.0) {
    const std::vector<float> now = sun.seen(t);
    // The disk's widest chord is .64 of its area over a radius, and 4 s take it by .04 radii or less.
    for (std::size_t i = 0; i < now.size(); ++i) EXPECT_NEAR(now[i], before[i], 0.64 * 0.04) << i << " " << t;
    before = now;
  }
  EXPECT_EQ(before, std::vector<float>(3, 1.0f));
}

TEST(SunExposure, RefusesWhatDoesNotFit) {
  const Casters prepared(town());
  const Ground ground;
  EXPECT_THROW(SunExposure(prepared, ground.receivers(), {{}, {{0, 0, 0}, {1, 0, 0}}}), UsageError);
  SunExposure sun(prepared, ground.receivers(), kBerlin);
  const std::vector<float> few(1), all(ground.points.size());
  EXPECT_THROW(sun.contacts(0.0, few, 1.0, few), UsageError);
  EXPECT_THROW(sun.contacts(1.0, all, 0.0, all), UsageError);
}

TEST(SeveralLights, GiveWhatEachOfThemGives) {
  const Casters prepared(town());
  const Ground ground;
  std::vector<LightShape> lights;
  for (int hour = 3; hour < 17; hour += 3)
    lights.emplace_back(sun_light(sun_position(kMorning + hour * kHour, kBerlin.site), kBerlin.axes));
  lights.emplace_back(DiskLight{{0, 40, 0}, {0, -1, 0}, 3.0});
  double told = 0.0;
  const auto results = visibility(prepared, std::span<const LightShape>(lights), ground.receivers(),
                                  {.progress = [&](double fraction) {
                                    EXPECT_GE(fraction, told);
                                    told = fraction;
                                    return true;
                                  }});
  ASSERT_EQ(results.size(), lights.size());
  for (std::size_t k = 0; k < lights.size(); ++k)
    EXPECT_EQ(results[k].visibility, visibility(prepared, lights[k], ground.receivers()).visibility) << k;
  EXPECT_TRUE(visibility(prepared, std::span<const LightShape>(), ground.receivers()).empty());
}

}  // namespace
}  // namespace penumbra
