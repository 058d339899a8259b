// Shafts against points of them: no triangle that meets a segment from T to the light is told to miss.
#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <random>

#include "mesh/vectors.h"
#include "volumes/solids/shafts/light_shaft.h"

namespace penumbra::detail {
namespace {

class LightShafts : public testing::TestWithParam<bool> {
 protected:
  Vec3 any(double size) {
    return size * Vec3(unit_(random_) - 0.5, unit_(random_) - 0.5, unit_(random_) - 0.5);
  }
  CircularLight light() {
    const Vec3 normal = Vec3(0.2, -1.0, 0.1) + any(0.5);
    if (GetParam()) return DistantLight{normal, 20.0 * unit_(random_)};
    const double far = std::pow(10.0, 6.0 * unit_(random_));
    return DiskLight{-(3.0 + far) * normal, normal, (0.05 + 0.3 * unit_(random_)) * (3.0 + far)};
  }
  /// A point of the light, or far on the way to it.
  Vec3 light_point(const CircularLight& light, const Vec3& from) {
    const LightFrame frame = light_frame(light);
    const double angle = 6.28318530717958648 * unit_(random_), r = light.radius * std::sqrt(unit_(random_));
    const Vec3 across = r * (std::cos(angle) * frame.u + std::sin(angle) * frame.v);
    return light.is_distant() ? from + 100.0 * (across - frame.w) : light.center + across;
  }

  std::mt19937_64 random_{7};
  std::uniform_real_distribution<double> unit_{0.0, 1.0};
};

TEST_P(LightShafts, NeverMissWhatASegmentMeets) {
  int misses = 0;
  for (int round = 0; round < 20'000; ++round) {
    const CircularLight l = light();
    const std::array<Vec3, 3> t{any(1.0), any(1.0), any(1.0)};
    const LightShaft shaft(l, light_frame(l), t, 10.0);
    // A point on a segment from T to the light, within reach, and a triangle through it.
    double u = unit_(random_), v = unit_(random_);
    if (u + v > 1.0) u = 1.0 - u, v = 1.0 - v;
    const Vec3 x = t[0] + u * (t[1] - t[0]) + v * (t[2] - t[0]);
    const Vec3 way = light_point(l, x) - x;
    const Vec3 p = x + std::min(1.0, 8.0 * unit_(random_) / glm::length(way)) * way;
    const Vec3 a = any(2.0), b = any(2.0);
    EXPECT_FALSE(shaft.misses(p + a, p + b, p - 0.7 * a - 0.2 * b)) << round;
    EXPECT_FALSE(shaft.misses_box(p - Vec3(0.1), p + Vec3(0.1))) << round;
    const Vec3 other = p + any(6.0);
    misses += shaft.misses(other, other + any(1.0), other + any(1.0)) ? 1 : 0;
  }
  EXPECT_GT(misses, 2'000);
}

TEST_P(LightShafts, MissWhatLiesAsideByLittle) {
  for (int round = 0; round < 2'000; ++round) {
    const CircularLight l = light();
    const LightFrame frame = light_frame(l);
    const Vec3 x = any(1.0);
    const LightShaft shaft(l, frame, std::span(&x, 1), 10.0);
    // Beside the segment from x to a point of the rim.
    const double angle = 6.28318530717958648 * unit_(random_);
    const Vec3 across = std::cos(angle) * frame.u + std::sin(angle) * frame.v;
    const Vec3 rim =
        l.is_distant() ? x + 100.0 * (l.radius * across - frame.w) : l.center + l.radius * across;
    const Vec3 way = glm::normalize(rim - x);
    // The plane that touches the cone there holds the ray and the rim's tangent.
    const Vec3 along = glm::normalize(glm::cross(frame.w, across)),
               out = glm::normalize(glm::cross(along, way));
    const Vec3 beside = x + unit_(random_) * way + (glm::dot(out, across) > 0.0 ? 1e-6 : -1e-6) * out;
    EXPECT_TRUE(shaft.misses(beside + 0.3 * along, beside - 0.3 * along, beside - 0.3 * along)) << round;
  }
}

INSTANTIATE_TEST_SUITE_P(NearAndDistant, LightShafts, testing::Bool());

}  // namespace
}  // namespace penumbra::detail
