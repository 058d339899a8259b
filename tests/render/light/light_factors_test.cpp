// What many receivers are told at once is what each would be told alone, bit for bit.
#include "render/light/light_factors.h"

#include <gtest/gtest.h>

#include "render/light/light_integrals.h"
#include "tests/render/render_support.h"

namespace penumbra::detail {
namespace {

using testing::Random;

struct Place {
  Vec3 point, normal;
};

/// Around the light: near and far, before and behind it, turned anywhere or so that their tangent planes meet
/// the light.
Place place_of(Random& random, const AreaLight& light, int k) {
  const double size = std::max(light.half.x, 0.1);
  const Vec3 point = light.center + size * random.spread(0.3, 100.0) * random.direction();
  if (k % 4 == 0) {
    const Vec3 at = light.center + size * random.uniform(-1.2, 1.2) * light.axes.u +
                    size * random.uniform(-1.2, 1.2) * light.axes.v;
    return {point, glm::normalize(glm::cross(at - point, random.direction()))};
  }
  if (k % 4 == 1) return {point, glm::normalize(light.center - point)};
  if (k % 40 == 2) return {light.center - size * random.spread(0.3, 10.0) * light.axes.w, light.axes.w};
  return {point, random.direction()};
}

/// Of all receivers: how many see all of the light, a part, nothing.
struct Seen {
  int all = 0, part = 0, none = 0;
};

Seen expect_same_as_alone(const LightShape& shape, std::uint64_t seed) {
  Random random(seed);
  const AreaLight light = area_light(shape);
  LightFactors factors;
  Seen seen;
  for (int round = 0; round < 40; ++round) {
    std::vector<Vec3> points, normals;
    const std::size_t count = round == 0 ? 1 : LightFactors::kMost - static_cast<std::size_t>(round % 9);
    for (std::size_t i = 0; i < count; ++i) {
      const Place place = place_of(random, light, static_cast<int>(i));
      points.push_back(place.point);
      normals.push_back(place.normal);
    }
    factors.find(light, points.data(), normals.data(), count);
    for (std::size_t i = 0; i < count; ++i) {
      const double factor = irradiance_factor(light, points[i], normals[i]);
      const double above = fraction_above_horizon(light, points[i], normals[i]);
      EXPECT_EQ(factors.at(i).irradiance, factor) << "seed " << seed << ", " << round << ", " << i;
      EXPECT_EQ(factors.at(i).above, above) << "seed " << seed << ", " << round << ", " << i;
      EXPECT_EQ(factors.is_behind(i), light.is_behind(points[i]));
      ++(above == 0.0 ? seen.none : above == 1.0 ? seen.all : seen.part);
    }
  }
  return seen;
}

TEST(LightFactorsProperty, AreThoseOfEachReceiverAlone) {
  const DiskLight disk{.center = {1, 4, -2}, .normal = {0.3, -1, 0.2}, .radius = 0.7};
  const DiskLight level{.center = {0, 5, 0}, .normal = {0, -1, 0}, .radius = 2.0};
  const DiskLight point{.center = {1, 4, -2}, .normal = {0.3, -1, 0.2}, .radius = 0.0};
  const DistantLight distant{.direction = {0.3, -1, 0.2}, .angle_degrees = 20.0};
  const RectangleLight rectangle{.center = {1, 4, -2}, .normal = {0.3, -1, 0.2}, .half_extents = {0.7, 0.3}};
  for (const LightShape& shape :
       {LightShape(disk), LightShape(level), LightShape(distant), LightShape(rectangle)}) {
    const Seen seen = expect_same_as_alone(shape, 4'711);
    EXPECT_GT(seen.all, 200);
    EXPECT_GT(seen.part, 50);
    EXPECT_GT(seen.none, 200);
  }
  expect_same_as_alone(point, 4'712);
}

}  // namespace
}  // namespace penumbra::detail
