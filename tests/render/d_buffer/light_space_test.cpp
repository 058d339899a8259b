#include "render/d_buffer/view/light_space.h"

#include <gtest/gtest.h>

#include <cmath>

#include "render/d_buffer/view/window_clip.h"
#include "tests/render/render_support.h"

namespace penumbra {
namespace {

using detail::LightSpace;
using detail::Uvh;
using testing::Random;

/// A light of any kind at any distance, and a window about the origin.
LightSpace random_space(Random& random, CircularLight& light) {
  const double distance = random.spread(3.0, 1e8);
  const Vec3 m = random.direction();
  const DiskLight disk{-distance * m, m, random.spread(1e-4, 0.5) * distance};
  light = random.uniform(0.0, 1.0) < 0.3 ? CircularLight(DistantLight{m, random.uniform(0.1, 60.0)})
                                         : CircularLight(disk);
  const LightSpace space(light, random.point(0.1), 1e-3);
  const Uvh zero = detail::divided(space.homogeneous(random.point(0.5)));
  return space.with_window(zero, random.spread(1e-3, 10.0));
}

Vec3 placed(const LightSpace& space, const Vec3& p) {
  const Uvh at = detail::divided(space.homogeneous(p));
  return {at.uv, at.h};
}

// d = (p_uv - x_uv) / (p_h - x_h).
TEST(LightSpace, TheWayToAPointOfTheDiskRunsAlongIt) {
  Random random(21);
  for (int k = 0; k < 2'000; ++k) {
    CircularLight light{DiskLight{}};
    const LightSpace space = random_space(random, light);
    const LightFrame axes = light_frame(light);
    const Vec3 x = random.point();
    const glm::dvec2 d = random.uniform(0.0, 1.0) * random.unit2();
    const Vec3 way = way_to_center(light, x) + light.radius * (d.x * axes.u + d.y * axes.v);
    const Vec3 up = placed(space, x + 0.5 / glm::length(way) * way) - placed(space, x);
    EXPECT_GT(up.z, 0.0);
    EXPECT_NEAR(up.x / up.z, d.x, 1e-9);
    EXPECT_NEAR(up.y / up.z, d.y, 1e-9);
  }
}

TEST(LightSpace, PlanesGiveHeightsAndHorizons) {
  Random random(22);
  for (int k = 0; k < 2'000; ++k) {
    CircularLight light{DiskLight{}};
    const LightSpace space = random_space(random, light);
    const Vec3 x = random.point(), p = random.point(), n = random.direction();
    const Vec3 plane = space.plane(n, x);
    const double above = glm::dot(plane, placed(space, p) - placed(space, x));
    EXPECT_EQ(above > 0.0, glm::dot(n, p - x) > 0.0);
    // δ of the horizon: the height of the center over the reach of the disk along the normal.
    const Vec3 m = light_frame(light).w;
    const double delta =
        glm::dot(n, way_to_center(light, x)) / (light.radius * glm::length(glm::cross(n, m)));
    EXPECT_NEAR(plane.z / std::hypot(plane.x, plane.y), delta, 1e-9 * (1.0 + std::abs(delta)));
  }
}

TEST(LightSpace, TheWindowsZeroIsZero) {
  Random random(23);
  CircularLight light{DiskLight{}};
  const LightSpace space = random_space(random, light);
  const LightSpace about = LightSpace(light, Vec3(0.0), 1e-3);
  const Uvh zero = detail::divided(about.homogeneous({0.3, 0.2, 0.1}));
  const Vec3 at = placed(about.with_window(zero, 1e-6), {0.3, 0.2, 0.1});
  EXPECT_LT(glm::length(at), 1e-6);
  EXPECT_GT(space.spread(), 0.0);
}

TEST(WindowClip, KeepsWhatIsAboutTheWindow) {
  Random random(24);
  int kept = 0;
  for (int k = 0; k < 1'000; ++k) {
    std::vector<glm::dvec4> triangle;
    double largest = 0.0;
    for (int i = 0; i < 3; ++i) {
      const double weight = random.uniform(-0.2, 1.0), size = random.spread(0.1, 1e6);
      triangle.push_back(weight * glm::dvec4(random.point(size), 1.0));
      largest = std::max(largest, glm::length(triangle.back()));
    }
    const auto clipped = detail::clipped_to_window(triangle, 2.0);
    const double rounding = 1e-15 * largest;
    kept += !clipped.empty();
    for (const glm::dvec4& p : clipped) {
      EXPECT_GT(p.w, 0.0);
      EXPECT_LE(std::max(std::abs(p.x), std::abs(p.y)), 2.0 * p.w + rounding);
      EXPECT_GE(p.z, -2.0 * p.w - rounding);
    }
  }
  EXPECT_GT(kept, 30);
  const std::vector<glm::dvec4> inside{{-1, -1, 0, 1}, {1, -1, 1, 1}, {0, 1, 5, 1}};
  EXPECT_EQ(detail::clipped_to_window(inside, 2.0), inside);
}

}  // namespace
}  // namespace penumbra
