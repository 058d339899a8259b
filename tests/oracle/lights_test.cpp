// Lights other than near disks: distant ones and rectangles, against closed forms and as limits of disks.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>

#include "penumbra/mesh/shapes.h"
#include "tests/oracle/oracle.h"
#include "tests/oracle/oracle_support.h"

namespace penumbra::oracle {
namespace {

constexpr int kSamples = 4096;
// The largest error that oracle.h states for a half-plane.
constexpr double kHalfPlane = 0.0024;

double seen(std::initializer_list<TriangleMesh> casters, const Vec3& x, const Light& light) {
  return Oracle(std::span(casters.begin(), casters.size())).unoccluded(x, {}, light, kSamples, 1);
}

/// Shines down; its disk at distance 1 has this radius.
DistantLight sun_above(double radius) {
  return {{0, -3, 0}, 2 * std::atan(radius) * 180 / std::numbers::pi};
}

TEST(DistantOracle, SamplesAreDirectionsWithinTheAngle) {
  for (const Vec3& direction : {Vec3(0, -1, 0), Vec3(1e-200, 2e-200, -3e-200), Vec3(4, 1, 0)})
    for (const double angle : {0.53, 40.0, 170.0}) {
      const Vec3 scaled =
          direction / std::max({std::abs(direction.x), std::abs(direction.y), std::abs(direction.z)});
      const Vec3 m = glm::normalize(scaled);
      const double half = std::tan(angle / 360 * std::numbers::pi);
      double squares = 0;
      Vec3 mean(0.0);
      for (const Vec3& q : light_samples(DistantLight{direction, angle}, 1000, 5)) {
        EXPECT_NEAR(glm::dot(q, m), -1, 1e-14 * (1 + half));
        const Vec3 across = q + m;
        EXPECT_LE(glm::length(across), half);
        squares += glm::dot(across, across) / 1000;
        mean += across / 1000.0;
      }
      EXPECT_NEAR(squares, half * half / 2, 1e-13 * half * half + 1e-17) << "equal areas";
      EXPECT_LT(glm::length(mean), 1e-3 * half);
    }
}

TEST(DistantOracle, HalfPlanesAtAnyHeightAndScale) {
  for (const double scale : {1e-9, 1.0, 1e9})
    for (const double height : {1e-6, 1.0, 1e6})
      for (const double d : {-1.01, -0.99, -0.5, -0.01, 0.2, 0.7, 0.999, 1.01}) {
        const double edge = d * 0.125 * height, far = 1e9;
        const auto sheet = make_sheet(height * scale, edge * scale, far * scale, -far * scale, far * scale);
        EXPECT_NEAR(seen({sheet}, Vec3(0.0), sun_above(0.125)), share_below(d), kHalfPlane)
            << scale << ' ' << height << ' ' << d;
      }
}

/// Under a light from any direction a half-plane is a chord: of the plane through x and the edge, with normal
/// n, at δ = n·c/(r|m × n|), c = -m/|m|.
TEST(DistantOracle, ChordsOfAnyDirection) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto point = [&] { return Vec3(uniform(random), uniform(random), uniform(random)); };
  int partial = 0;
  for (int i = 0; i < 300; ++i) {
    const Vec3 m = glm::normalize(point()), x = 100.0 * point();
    const double radius = 0.02 + 0.4 * std::abs(uniform(random));
    // An edge that passes the axis at a distance of up to 1.2 radii, and a plate beyond it.
    const Vec3 u = glm::normalize(glm::cross(m, point())), v = glm::cross(m, u);
    const double height = 5 + 4 * uniform(random);
    const Vec3 at = x + height * (-m + 1.2 * radius * uniform(random) * u),
               along = 1e3 * glm::normalize(v + 0.4 * uniform(random) * u + 0.4 * uniform(random) * m),
               beyond = 1e3 * (u + 0.3 * uniform(random) * m);
    const auto plate = make_quad(at - along, at + along, at + along + beyond, at - along + beyond);
    Vec3 n = glm::cross(at - x, along);
    if (glm::dot(n, u) > 0) n = -n;  // on the open side
    const double delta = glm::dot(n, -m) / (radius * glm::length(glm::cross(m, n)));
    const DistantLight light{2.5 * m, 2 * std::atan(radius) * 180 / std::numbers::pi};
    const double expected = share_below(delta);
    EXPECT_NEAR(seen({plate}, x, light), expected, kHalfPlane) << i;
    partial += expected > 0 && expected < 1;
  }
  EXPECT_GT(partial, 150);
}

TEST(DistantOracle, Slab) {
  for (const double width : {0.01, 0.3, 0.9, 1.2})
    for (const double off : {0.0, 0.4, -0.8}) {
      const double unit = 0.125 * 1.5;
      const auto slab = make_sheet(1.5, (off - width) * unit, (off + width) * unit, -9, 9);
      EXPECT_NEAR(seen({slab}, Vec3(0.0), sun_above(0.125)),
                  1 - share_below(off + width) + share_below(off - width), 2 * kHalfPlane);
    }
}

TEST(DistantOracle, HoleInAPlate) {
  const TriangleMesh plate = make_plate_with_hole(2.0, 0.1, 50);
  for (const double radius : {0.025, 0.05, 0.1, 0.2})
    for (const double off : {0.0, 0.05, 0.2, 0.35, 0.8})
      EXPECT_NEAR(seen({plate}, {off, 0, 0}, sun_above(radius)),
                  share_in_disk(0.05 / radius, off / 2 / radius), 0.003)
          << radius << ' ' << off;
}

// A wall stands just beside x and carries a roof: both end at the same edge, and rays near it are blocked
// once.
TEST(DistantOracle, TwoPlanesAtAnEdgeNearTheReceiver) {
  for (const double away : {1e-12, 1e-7, 1e-2})
    for (const double d : {0.0625, 0.5, 0.875}) {
      const double height = away * 8 / d;
      const auto wall = make_quad({away, 0, -99}, {away, 0, 99}, {away, height, 99}, {away, height, -99});
      const auto roof = make_sheet(height, away, 99, -99, 99);
      const DistantLight light = sun_above(0.125);
      EXPECT_NEAR(seen({wall, roof}, Vec3(0.0), light), share_below(d), kHalfPlane);
      EXPECT_NEAR(seen({roof}, Vec3(0.0), light), share_below(d), kHalfPlane);
      EXPECT_NEAR(seen({wall}, Vec3(0.0), light), share_below(d), kHalfPlane);
    }
}

TEST(DistantOracle, HorizonIsOneMoreChordAndNothingIsBehind) {
  const Oracle empty({});
  for (const double d : {-1.1, -0.7, 0.0, 0.3, 0.95, 1.1})
    for (const Vec3& x : {Vec3(0.0), Vec3(1e9, -1e9, 1e9)})
      EXPECT_NEAR(empty.visibility(x, {1, 0.125 * d, 0}, {}, sun_above(0.125), kSamples, 3), share_below(d),
                  kHalfPlane);
  for (const double y : {-1e200, 0.0, 1e200})
    EXPECT_EQ(empty.unoccluded({0, y, 0}, {}, sun_above(0.125), kSamples, 3), 1);
  // However far the plate is; behind x it hides nothing.
  for (const double y : {1e-9, 1.0, 1e9, 1e30}) {
    EXPECT_EQ(seen({make_sheet(y, -9 * y, 9 * y, -9 * y, 9 * y)}, Vec3(0.0), sun_above(0.125)), 0);
    EXPECT_EQ(seen({make_sheet(-y, -9 * y, 9 * y, -9 * y, 9 * y)}, Vec3(0.0), sun_above(0.125)), 1);
  }
}

TEST(DistantOracle, AngleZeroIsOneRay) {
  const DistantLight point{{0, -1, 0}, 0.0};
  EXPECT_EQ(seen({make_sheet(1, -1, 1, -1, 1)}, Vec3(0.0), point), 0);
  EXPECT_EQ(seen({make_sheet(1, 1e-12, 1, -1, 1)}, Vec3(0.0), point), 1);
  EXPECT_EQ(seen({make_sheet(1, 0, 1, -1, 1)}, Vec3(0.0), point), 0) << "an edge blocks";
}

/// The mean over many receivers of |V - V of the distant light|, for disks of the same angle. Samples of one
/// seed lie at the same place of either disk, so that only geometry differs.
double difference_of_disks(const Oracle& oracle, const std::vector<Vec3>& receivers, double distance) {
  const DistantLight sun{{0.6, -0.8, 0.0}, 0.53};
  const double radius = distance * std::tan(0.53 / 360 * std::numbers::pi);
  const DiskLight disk{-distance * sun.direction, sun.direction, radius};
  double sum = 0;
  for (std::size_t i = 0; i < receivers.size(); ++i)
    sum += std::abs(oracle.unoccluded(receivers[i], {}, disk, 1024, i) -
                    oracle.unoccluded(receivers[i], {}, sun, 1024, i));
  return sum / static_cast<double>(receivers.size());
}

TEST(DistantOracle, IsTheLimitOfDisks) {
  const TriangleMesh casters[] = {make_box({0, 0.5, 0}, {0.5, 0.5, 0.5}),
                                  make_sheet(1.5, -0.2, 0.9, -0.4, 0.3)};
  const Oracle oracle(casters);
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<Vec3> receivers;
  while (receivers.size() < 4000) {
    const Vec3 x(3 * uniform(random) - 0.5, 0, 2 * uniform(random) - 1);
    const double share = oracle.unoccluded(x, {}, DistantLight{{0.6, -0.8, 0.0}, 0.53}, 64, receivers.size());
    if (share > 0 && share < 1) receivers.push_back(x);
  }
  double difference[4];
  const double distances[] = {1e3, 1e4, 1e6, 1e8};
  for (int i = 0; i < 4; ++i) difference[i] = difference_of_disks(oracle, receivers, distances[i]);
  // Receivers are up to 2 units apart and the penumbra's width is .0093 of the distance to the caster: over
  // 1e3 units a disk's image moves by a good part of its radius.
  EXPECT_GT(difference[0], 0.03);
  EXPECT_LT(difference[0], 0.6);
  EXPECT_NEAR(difference[0] / difference[1], 10, 2.5);
  EXPECT_NEAR(difference[1] / difference[2], 100, 25);
  // Some ten of four million samples are left at the last.
  EXPECT_GT(difference[2] / difference[3], 40);
}

TEST(RectangleOracle, HalfPlanesSlabsAndHorizons) {
  const Rectangle light{{0, 4, 0}, {0.5, 0, 0}, {0, 0, 0.25}};  // u × v points down
  for (const double d : {-1.01, -0.6, 0.0, 0.3, 0.95, 1.01}) {
    // At height 2 the light's image is half as large: it covers |x| ≤ .25, |z| ≤ .125.
    EXPECT_NEAR(seen({make_sheet(2, 0.25 * d, 9, -9, 9)}, Vec3(0.0), light),
                std::clamp((1 + d) / 2, 0.0, 1.0), kHalfPlane);
    EXPECT_NEAR(seen({make_sheet(2, -9, 9, 0.125 * d, 9)}, Vec3(0.0), light),
                std::clamp((1 + d) / 2, 0.0, 1.0), kHalfPlane);
    EXPECT_NEAR(Oracle({}).visibility(Vec3(0.0), {8, d, 0}, {}, light, kSamples, 3),
                std::clamp((1 + d) / 2, 0.0, 1.0), kHalfPlane);
  }
  EXPECT_NEAR(seen({make_sheet(2, -0.1, 0.05, -0.05, 0.1)}, Vec3(0.0), light), 1 - 0.15 / 0.5 * 0.15 / 0.25,
              2 * kHalfPlane);
  EXPECT_EQ(seen({}, {0, 4, 0}, light), 0);
  EXPECT_EQ(seen({}, {0, 5, 0}, light), 0);
  EXPECT_EQ(seen({make_sheet(4, -9, 9, -9, 9)}, Vec3(0.0), light), 1) << "nothing in the light's plane casts";
}

TEST(RectangleOracle, ErrorOfAHalfPlaneIsAsStated) {
  const Rectangle light{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  double squares = 0;
  constexpr int kLines = 1000;
  for (int i = 0; i < kLines; ++i) {
    // The line passes through the square's upper and lower side: a trapezoid is left of it.
    const double bottom = uniform(random), top = uniform(random);
    int left = 0;
    for (const Vec3& p : light_samples(light, 1024, random()))
      left += p.x < bottom + (top - bottom) * (p.y + 1) / 2;
    const double error = left / 1024.0 - (bottom + top + 2) / 4;
    squares += error * error;
  }
  EXPECT_LT(std::sqrt(squares / kLines), 0.0023);
}

}  // namespace
}  // namespace penumbra::oracle
