// Form factor and area above the horizon of distant lights: closed forms, sums over directions, and disks
// that recede.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "render/light/light_integrals.h"
#include "tests/render/render_support.h"

namespace penumbra {
namespace {

using testing::kPi;
using testing::Random;

constexpr double kAngles[] = {1e-6, 0.01, 0.53, 10.0, 60.0, 120.0, 175.0};

double half_angle(const DistantLight& light) {
  return 0.5 * glm::radians(light.angle_degrees);
}

struct Sums {
  double factor = 0.0;  ///< the integral of max(0, n·ω) over the disk's directions
  double above = 0.0;   ///< the part of the disk's area with n·ω > 0
};

/// By the midpoint rule on the sphere, in rings about the light's direction. The area element of the disk at
/// unit distance is dω / cos³θ.
Sums over_directions(const DistantLight& light, const Vec3& n, int rings, int sectors) {
  const LightFrame f = light_frame(DiskLight{.normal = light.direction});
  const double ring = half_angle(light) / rings, sector = 2.0 * kPi / sectors;
  Sums out;
  double area = 0.0;
  for (int i = 0; i < rings; ++i) {
    const double theta = (i + 0.5) * ring, solid = std::sin(theta) * ring * sector;
    const double weight = solid / std::pow(std::cos(theta), 3);
    for (int j = 0; j < sectors; ++j) {
      const double phi = (j + 0.5) * sector;
      const Vec3 omega =
          std::sin(theta) * (std::cos(phi) * f.u + std::sin(phi) * f.v) - std::cos(theta) * f.w;
      const double cosine = glm::dot(n, omega);
      area += weight;
      if (cosine <= 0.0) continue;
      out.factor += cosine * solid;
      out.above += weight;
    }
  }
  out.above /= area;
  return out;
}

/// A normal whose horizon cuts the light's disk.
Vec3 normal_at_the_horizon(Random& random, const DistantLight& light) {
  const LightFrame f = light_frame(DiskLight{.normal = light.direction});
  const double phi = random.uniform(0.0, 2.0 * kPi),
               tilt = 0.5 * kPi + half_angle(light) * random.uniform(-1.0, 1.0);
  return std::sin(tilt) * (std::cos(phi) * f.u + std::sin(phi) * f.v) - std::cos(tilt) * f.w;
}

TEST(DistantIntegrals, OfAFloorAreTheIrradianceTimesTheSineOfTheElevation) {
  for (const double angle : kAngles)
    for (double elevation = 0.5 * angle; elevation <= 90.0; elevation += 3.0) {
      const double e = glm::radians(elevation);
      const DistantLight light{.direction = {-2.0 * std::cos(e), -2.0 * std::sin(e), 0},
                               .angle_degrees = angle};
      const AreaLight area = area_light(light);
      const double facing = irradiance_per_radiance(light), sine = std::sin(half_angle(light));
      EXPECT_NEAR(facing, kPi * sine * sine, 1e-15 * facing);
      EXPECT_NEAR(irradiance_factor(area, {7, 0, -3}, {0, 1, 0}), facing * std::sin(e), 1e-9 * facing)
          << angle << "° at " << elevation << "°";
      EXPECT_NEAR(fraction_above_horizon(area, {7, 0, -3}, {0, 1, 0}), 1.0, 1e-9);
    }
}

TEST(DistantIntegrals, OfAngleZeroAreTheCosine) {
  Random random(5);
  for (int k = 0; k < 1'000; ++k) {
    const DistantLight light{.direction = random.spread(1e-3, 1e3) * random.direction(),
                             .angle_degrees = 0.0};
    const Vec3 n = random.direction();
    const double cosine = -glm::dot(glm::normalize(light.direction), n);
    EXPECT_NEAR(irradiance_factor(area_light(light), random.point(), n), std::max(0.0, cosine), 1e-15);
    EXPECT_EQ(fraction_above_horizon(area_light(light), random.point(), n), cosine > 0.0 ? 1.0 : 0.0);
  }
  EXPECT_EQ(irradiance_per_radiance({.angle_degrees = 0.0}), 1.0);
}

TEST(DistantIntegralsProperty, AgreeWithSumsOverDirections) {
  constexpr std::uint64_t kSeed = 2'718;
  Random random(kSeed);
  double worst_factor = 0.0, worst_above = 0.0;
  int cut = 0;
  for (int k = 0; k < 200; ++k) {
    const DistantLight light{.direction = random.direction(), .angle_degrees = random.uniform(0.1, 170.0)};
    const Vec3 n = k % 4 ? normal_at_the_horizon(random, light) : random.direction();
    const Sums expected = over_directions(light, n, 400, 800);
    const AreaLight area = area_light(light);
    const double all = irradiance_per_radiance(light),
                 above = fraction_above_horizon(area, random.point(), n);
    const double factor_error = std::abs(irradiance_factor(area, random.point(), n) - expected.factor) / all;
    // The sum is wrong by the cells that the horizon cuts. The widest ring of a disk of 170° has 1/40 of its
    // area.
    ASSERT_LE(factor_error, 2e-5) << "seed " << kSeed << ", " << k << ", " << light.angle_degrees << "°";
    ASSERT_NEAR(above, expected.above, 2e-3) << "seed " << kSeed << ", " << k << ", " << light.angle_degrees;
    worst_factor = std::max(worst_factor, factor_error);
    worst_above = std::max(worst_above, std::abs(above - expected.above));
    cut += above > 0.0 && above < 1.0;
  }
  EXPECT_GT(cut, 100);
  std::printf("worst: %.2g of the factor, %.2g of the area; %d cut by the horizon\n", worst_factor,
              worst_above, cut);
}

// Against the formula of near disks, of another derivation, with the disk on the axis at unit distance.
TEST(DistantIntegralsProperty, AreThoseOfTheDiskAtUnitDistance) {
  constexpr std::uint64_t kSeed = 1'414;
  Random random(kSeed);
  for (int k = 0; k < 20'000; ++k) {
    const DistantLight light{.direction = random.direction(), .angle_degrees = random.spread(1e-3, 179.0)};
    const Vec3 n = k % 4 ? normal_at_the_horizon(random, light) : random.direction();
    const DiskLight disk{-light.direction, light.direction, CircularLight(light).radius};
    const AreaLight far = area_light(light), near = area_light(disk);
    // The near disk's place rounds, and its arc and chord, both of the order of the radius, round before they
    // cancel.
    ASSERT_NEAR(irradiance_factor(far, random.point(), n), irradiance_factor(near, Vec3(0.0), n),
                2e-15 * disk.radius / (1.0 + disk.radius) + 1e-12 * irradiance_per_radiance(light))
        << "seed " << kSeed << ", " << k << ", " << light.angle_degrees << "°";
    ASSERT_NEAR(fraction_above_horizon(far, random.point(), n), fraction_above_horizon(near, Vec3(0.0), n),
                1e-12 + 4e-16 / disk.radius)
        << "seed " << kSeed << ", " << k << ", " << light.angle_degrees << "°";
  }
}

// A small disk is a plane figure: with the height δρ + ρ q above the horizon at the disk's point ρ q the
// factor is ρ³ (δ area + first moment), off by the order of ρ².
TEST(DistantIntegrals, OfASmallDiskAtTheHorizonKeepTheirDigits) {
  for (const double angle : {1e-2, 1e-4, 1e-8, 1e-12})
    for (double delta = -0.95; delta < 1.0; delta += 0.1) {
      const AreaLight light = area_light(DistantLight{.direction = {0, 0, 1}, .angle_degrees = angle});
      const double rho = light.half.x, moment = 2.0 / 3.0 * std::pow(1.0 - delta * delta, 1.5);
      const double expected = rho * rho * rho * (delta * kPi * half_plane_area(delta) + moment);
      const Vec3 n = glm::normalize(Vec3(1, 0, -delta * rho));
      EXPECT_NEAR(irradiance_factor(light, Vec3(0.0), n), expected, (4.0 * rho * rho + 1e-11) * expected)
          << angle << "°, δ " << delta;
    }
}

// A disk of the same angle at distance D, seen from a place of size 1: its direction is off by 1/D and its
// radius by a factor of 1 ± 1/D. So both factors differ by the order of 1/D, the area by that of 1/(D
// tan(angle/2)).
TEST(DistantIntegralsProperty, AreTheLimitsOfADiskThatRecedes) {
  constexpr std::uint64_t kSeed = 1'618;
  for (const double angle : kAngles) {
    double before_factor = 0.0, before_above = 0.0;
    for (const double distance : {1e3, 1e4, 1e5, 1e6, 1e7, 1e8}) {
      Random random(kSeed);  // the same places for each distance
      double factor = 0.0, above = 0.0;
      for (int k = 0; k < 2'000; ++k) {
        const DistantLight light{.direction = random.direction(), .angle_degrees = angle};
        const DiskLight disk{-distance * light.direction, light.direction,
                             distance * std::tan(half_angle(light))};
        const Vec3 x = random.point(0.5),
                   n = k % 2 ? random.direction() : normal_at_the_horizon(random, light);
        const AreaLight far = area_light(light), near = area_light(disk);
        factor = std::max(factor, std::abs(irradiance_factor(near, x, n) - irradiance_factor(far, x, n)) /
                                      irradiance_per_radiance(light));
        above =
            std::max(above, std::abs(fraction_above_horizon(near, x, n) - fraction_above_horizon(far, x, n)));
      }
      const double radius = std::tan(0.5 * glm::radians(angle));
      EXPECT_LE(factor, 4.0 / distance + 1e-15 / radius + 1e-13) << angle << "° at " << distance;
      EXPECT_LE(above, (1.0 + 1.0 / radius) / distance + 1e-13 / radius) << angle << "° at " << distance;
      // Near disks that the horizon cuts round by 1e-16 of their radius, the factor is of the order of its
      // square.
      if (factor > 1e-11 + 1e-15 / radius && before_factor > 0.0) {
        EXPECT_LT(factor, 0.15 * before_factor) << angle << "° at " << distance;
      }
      // An area is at most 1, so that it falls only once the disk is small beside what the place changes.
      if (above > 1e-11 / radius && before_above > 0.0 && before_above < 0.1) {
        EXPECT_LT(above, 0.15 * before_above) << angle << "° at " << distance;
      }
      before_factor = factor, before_above = above;
    }
    EXPECT_GT(before_factor, 0.0) << "the disks are not the limit itself";
  }
}

}  // namespace
}  // namespace penumbra
