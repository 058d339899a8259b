#include "render/shading/shading.h"

#include <gtest/gtest.h>

#include "render/light/light_integrals.h"
#include "tests/render/render_support.h"

namespace penumbra {
namespace {

using testing::kPi;
using testing::Random;

/// The integral of cos θ cos θ' / d² over the disk above the horizon, by the midpoint rule on rings of equal
/// width.
double factor_by_quadrature(const DiskLight& light, const Vec3& x, const Vec3& n, int rings, int sectors) {
  const LightFrame f = light_frame(light);
  const double ring = light.radius / rings, sector = 2.0 * kPi / sectors;
  double sum = 0.0;
  for (int i = 0; i < rings; ++i) {
    const double rho = (i + 0.5) * ring;
    double around = 0.0;
    for (int j = 0; j < sectors; ++j) {
      const double angle = (j + 0.5) * sector;
      const Vec3 d = light.center + rho * (std::cos(angle) * f.u + std::sin(angle) * f.v) - x;
      const double d2 = glm::dot(d, d);
      around += std::max(0.0, glm::dot(n, d)) * std::max(0.0, -glm::dot(f.w, d)) / (d2 * d2);
    }
    sum += around * rho;
  }
  return sum * ring * sector;
}

TEST(DiskIrradianceFactor, OnTheAxisFacingTheDisk) {
  for (const double d : {1e-3, 0.1, 1.0, 7.0, 1e4}) {
    const DiskLight light{{1, 2, 3}, {0, -2, 0}, 0.5};
    const double expected = kPi * 0.25 / (0.25 + d * d);
    EXPECT_NEAR(disk_irradiance_factor(light, {1, 2 - d, 3}, {0, 1, 0}), expected, 1e-12 * expected) << d;
  }
}

TEST(DiskIrradianceFactor, IsNothingBehindTheLightOrBelowTheHorizon) {
  const DiskLight light{{0, 2, 0}, {0, -1, 0}, 0.5};
  EXPECT_EQ(disk_irradiance_factor(light, {0, 3, 0}, {0, -1, 0}), 0.0);
  EXPECT_EQ(disk_irradiance_factor(light, {4, 2, 0}, {-1, 0, 0}), 0.0);
  EXPECT_EQ(disk_irradiance_factor(light, {0, 0, 0}, {0, -1, 0}), 0.0);
  EXPECT_EQ(fraction_above_horizon(light, {0, 3, 0}, {0, -1, 0}), 0.0);
  EXPECT_EQ(fraction_above_horizon(light, {0, 0, 0}, {0, -1, 0}), 0.0);
  EXPECT_EQ(fraction_above_horizon(light, {0, 0, 0}, {0, 1, 0}), 1.0);
  EXPECT_NEAR(fraction_above_horizon(light, {0, 0, 0}, {1, 0, 0}), 0.5, 1e-15);
}

TEST(DiskIrradianceFactor, OfRadiusZeroIsThePointLights) {
  const DiskLight light{{0, 2, 0}, {0, -1, 0}, 0.0};
  const Vec3 x{1, 0, 0.5}, n = glm::normalize(Vec3(0.2, 1, 0.1)), d = light.center - x;
  const double d2 = glm::dot(d, d);
  EXPECT_NEAR(disk_irradiance_factor(light, x, n), glm::dot(n, d) * d.y / (d2 * d2), 1e-15);
  EXPECT_EQ(disk_irradiance_factor(light, x, -n), 0.0);
  EXPECT_EQ(fraction_above_horizon(light, x, n), 1.0);
  EXPECT_EQ(fraction_above_horizon(light, x, -n), 0.0);
}

// A small disk is a point light of π r² the intensity; the error is of the order of (r/d)².
TEST(DiskIrradianceFactor, OfASmallDiskTendsToThePointLights) {
  const Vec3 x{1, 0, 0.5}, n = glm::normalize(Vec3(0.2, 1, 0.1));
  const double point = disk_irradiance_factor({{0, 2, 0}, {0, -1, 0}, 0.0}, x, n);
  for (const double r : {1e-2, 1e-3, 1e-4}) {
    const double disk = disk_irradiance_factor({{0, 2, 0}, {0, -1, 0}, r}, x, n);
    EXPECT_NEAR(disk / (kPi * r * r * point), 1.0, r * r + 1e-7) << r;
  }
}

struct Place {
  Vec3 x, n;
  const char* kind;
};

/// The k-th of a mixture of receivers of the unit disk about the origin, light towards +z.
Place place_of(Random& random, int k) {
  const auto about = [&](double depth, double away) {
    const glm::dvec2 at = away * random.unit2();
    return Vec3(at, depth);
  };
  switch (k % 5) {
    case 0:
      return {about(random.spread(0.5, 20), random.spread(0.1, 10)), random.direction(), "anywhere"};
    case 1:
      return {about(random.spread(0.5, 20), 0.0), random.direction(), "on the axis"};
    case 2:
      return {about(random.spread(0.5, 20), random.spread(1e-15, 1e-3)), random.direction(), "near the axis"};
    case 3: {  // the tangent plane meets the disk
      const Vec3 x = about(random.spread(0.5, 10), random.uniform(0.1, 5));
      const Vec3 towards = glm::normalize(Vec3(random.uniform(0.0, 1.0) * random.unit2(), 0.0) - x);
      const Vec3 n = glm::normalize(glm::cross(towards, random.direction()));
      return {x, n, "grazing"};
    }
    default:
      return {about(random.spread(0.05, 0.5), random.uniform(0.0, 1.5)), random.direction(), "close"};
  }
}

TEST(DiskIrradianceFactorProperty, AgreesWithQuadrature) {
  constexpr std::uint64_t kSeed = 3'141;
  Random random(kSeed);
  double worst = 0.0;
  for (int k = 0; k < 250; ++k) {
    const Place p = place_of(random, k);
    // The same place in another frame and at another scale.
    const DiskLight light{random.point(5.0), 3.0 * random.direction(), random.spread(0.01, 100.0)};
    const LightFrame f = light_frame(light);
    const auto turned = [&](const Vec3& v) { return v.x * f.u + v.y * f.v + v.z * f.w; };
    const Vec3 x = light.center + light.radius * turned(p.x), n = turned(p.n);
    const bool close = k % 5 == 4;
    const double expected = factor_by_quadrature(light, x, n, close ? 1200 : 300, close ? 1200 : 600);
    const double all = kPi * 1.0 / (1.0 + p.x.z * p.x.z);  // what a receiver on the axis would get
    const double error = std::abs(disk_irradiance_factor(light, x, n) - expected) / all;
    worst = std::max(worst, error);
    // Midpoints on a grid of step h are wrong by the order of h² times the integrand's curvature, and by h²
    // where the horizon cuts it.
    ASSERT_LE(error, 1e-4) << "seed " << kSeed << ", receiver " << k << ", " << p.kind << ", " << expected;
  }
  std::printf("worst difference: %.2g of the factor on the axis\n", worst);
}

TEST(DiskIrradianceFactorProperty, OfTwoSidesDifferByThePlainLambertIntegral) {
  // Clipped factors of n and -n: their difference is the unclipped integral, which is linear in n.
  constexpr std::uint64_t kSeed = 3'142;
  Random random(kSeed);
  const DiskLight light{Vec3(0.0), Vec3(0, 0, 1), 1.0};
  for (int k = 0; k < 2'000; ++k) {
    const Place p = place_of(random, k);
    const auto signed_factor = [&](const Vec3& n) {
      return disk_irradiance_factor(light, p.x, n) - disk_irradiance_factor(light, p.x, -n);
    };
    const double sum = p.n.x * signed_factor({1, 0, 0}) + p.n.y * signed_factor({0, 1, 0}) +
                       p.n.z * signed_factor({0, 0, 1});
    ASSERT_NEAR(signed_factor(p.n), sum, 1e-11) << "seed " << kSeed << ", receiver " << k << ", " << p.kind;
    ASSERT_NEAR(fraction_above_horizon(light, p.x, p.n) + fraction_above_horizon(light, p.x, -p.n), 1.0,
                1e-12)
        << k;
  }
}

Image shade_under_one_light(const Scene& scene, const SurfaceBuffer& surface,
                            const testing::Values& visibility) {
  return shade(scene, surface, std::vector<LightVisibility>{{visibility, {}}}, detail::make_threads(2));
}

TEST(Shade, IsTheProductOfItsFactors) {
  Scene scene = testing::scene_in_light_frame(0.5, {testing::rectangle(-1, 1, -1, 1, 4)});
  scene.objects[0].albedo = {0.2, 0.4, 0.8};
  scene.lights.front().radiance = {3, 5, 7};
  const Vec3 x{0.5, 0.25, 4}, up{0, 0, -1}, down{0, 0, 1}, side{1, 0, 0};
  SurfaceBuffer surface = testing::receivers({x, x, x, {0, 0, 4}, {0, 0, -1}, x},
                                             std::vector<Vec3>{up, up, down, side, up, up}, 3);
  surface.object[5] = -1;
  const Image image = shade_under_one_light(scene, surface, {1.0f, 0.25f, 0.0f, 0.5f, 0.0f, 1.0f});
  const double factor = disk_irradiance_factor(testing::light_of(scene), x, up);
  const char* names[] = {"R", "G", "B"};
  for (int k = 0; k < 3; ++k) {
    const auto& channel = image.at(names[k]);
    const double full = scene.objects[0].albedo[k] / kPi * scene.lights.front().radiance[k];
    EXPECT_NEAR(channel[0], full * factor, 1e-6 * full);
    EXPECT_NEAR(channel[1], full * factor * 0.25, 1e-6 * full);
    EXPECT_EQ(channel[2], 0.0f) << "V_h is 0";
    // The horizon halves the disk, and what is above it is wholly visible.
    EXPECT_NEAR(channel[3], full * disk_irradiance_factor(testing::light_of(scene), {0, 0, 4}, side),
                1e-6 * full);
    EXPECT_EQ(channel[4], 0.0f) << "behind the light";
    EXPECT_EQ(channel[5], 0.0f) << "nothing seen";
  }
  EXPECT_EQ(image.at("A"), (testing::Values{1, 1, 1, 1, 1, 0}));
  EXPECT_EQ(image.at("visibility"), (testing::Values{1, 0.25f, 0, 0.5f, 0, 1}));
  EXPECT_EQ(image.at("region"), (testing::Values{-1, -1, -1, -1, 2, -1}));
  EXPECT_EQ(image.at("object"), (testing::Values{0, 0, 0, 0, 0, -1}));
  EXPECT_EQ(image.at("P.X")[0], 0.5f);
  EXPECT_EQ(image.at("N.Z")[0], -1.0f);
}

TEST(Shade, OfRadiusZeroIsAPointLight) {
  Scene scene = testing::scene_in_light_frame(0.0, {testing::rectangle(-1, 1, -1, 1, 4)});
  scene.lights.front().radiance = Vec3(3.0);
  const Vec3 x{1, 0, 4};
  const SurfaceBuffer surface = testing::receivers({x, x}, Vec3(0, 0, -1), 2);
  const Image image = shade_under_one_light(scene, surface, {1.0f, 0.0f});
  const double d2 = 17.0;
  EXPECT_NEAR(image.at("G")[0], 0.8 / kPi * 3.0 * 4.0 * 4.0 / (d2 * d2), 1e-7);
  EXPECT_EQ(image.at("G")[1], 0.0f);
}

// A floor under a sun at elevation e gets E sin e where nothing is in the way, wherever it is; so does it
// under a point at infinity.
TEST(Shade, OfADistantLightIsByItsIrradiance) {
  for (const double angle : {0.0, 0.53, 40.0})
    for (const double elevation : {25.0, 60.0, 90.0}) {
      const double e = elevation * kPi / 180.0;
      const DistantLight sun{.direction = {0, -std::sin(e), std::cos(e)}, .angle_degrees = angle};
      Scene scene = testing::scene_in_light_frame(0.5, {testing::rectangle(-1, 1, -1, 1, 4)});
      scene.objects[0].albedo = {0.2, 0.4, 0.8};
      scene.lights = {{.name = {}, .shape = sun, .radiance = Vec3(3, 5, 7) / irradiance_per_radiance(sun)}};
      const Vec3 x{0.5, 0, -3}, far{1e7, 0, 1e7}, up{0, 1, 0};
      const SurfaceBuffer surface = testing::receivers({x, x, far, x}, std::vector<Vec3>{up, up, up, -up}, 2);
      const Image image = shade_under_one_light(scene, surface, {1.0f, 0.25f, 1.0f, 0.0f});
      const char* names[] = {"R", "G", "B"};
      for (int k = 0; k < 3; ++k) {
        const auto& channel = image.at(names[k]);
        const double full = scene.objects[0].albedo[k] / kPi * (3 + 2 * k) * std::sin(e);
        EXPECT_NEAR(channel[0], full, 1e-6 * full) << angle << "° at " << elevation << "°";
        EXPECT_NEAR(channel[1], 0.25 * full, 1e-6 * full);
        EXPECT_EQ(channel[2], channel[0]) << "it has no place";
        EXPECT_EQ(channel[3], 0.0f) << "below the horizon";
      }
      EXPECT_EQ(image.at("region"), (testing::Values{-1, -1, -1, -1})) << "nothing is behind it";
    }
}

/// Integral of cos θ cos θ' / d² and area fraction above the horizon by the midpoint rule.
struct RectangleSums {
  double factor = 0.0, above = 0.0;
};
RectangleSums rectangle_by_quadrature(const AreaLight& light, const Vec3& x, const Vec3& n, int cells) {
  RectangleSums out;
  for (int j = 0; j < cells; ++j)
    for (int i = 0; i < cells; ++i) {
      const double a = light.half.x * (2.0 * (i + 0.5) / cells - 1.0),
                   b = light.half.y * (2.0 * (j + 0.5) / cells - 1.0);
      const Vec3 d = light.center + a * light.axes.u + b * light.axes.v - x;
      const double d2 = glm::dot(d, d);
      out.factor += std::max(0.0, glm::dot(n, d)) * std::max(0.0, -glm::dot(light.axes.w, d)) / (d2 * d2);
      out.above += glm::dot(n, d) > 0.0;
    }
  out.factor *= 4.0 * light.half.x * light.half.y / (cells * cells);
  out.above /= cells * cells;
  return out;
}

TEST(RectangleIrradianceFactor, IsTheIntegralOverWhatTheHorizonLeaves) {
  constexpr std::uint64_t kSeed = 12;
  Random random(kSeed);
  const AreaLight light{light_frame({{1, 2, 3}, {0.2, -1, 0.1}, 0.0}), {1, 2, 3}, {0.7, 0.2}, false};
  int cut = 0;
  for (int k = 0; k < 300; ++k) {
    const Vec3 x = light.center + random.spread(0.2, 5.0) * (light.axes.w + 0.8 * random.point()),
               n = random.direction();
    const RectangleSums expected = rectangle_by_quadrature(light, x, n, 400);
    const bool behind = glm::dot(x - light.center, light.axes.w) <= 0.0;
    ASSERT_NEAR(fraction_above_horizon(light, x, n), behind ? 0.0 : expected.above, 0.004)
        << "seed " << kSeed << ", receiver " << k;
    ASSERT_NEAR(irradiance_factor(light, x, n), expected.factor, 2e-4 * (1.0 + expected.factor))
        << "seed " << kSeed << ", receiver " << k;
    cut += expected.above > 0.0 && expected.above < 1.0;
  }
  EXPECT_GT(cut, 20);
}

}  // namespace
}  // namespace penumbra
