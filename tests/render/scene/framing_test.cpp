#include "render/scene/framing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "tests/render/render_support.h"

namespace penumbra {
namespace {

using testing::Random;

/// How far out points lie on each side of the picture, 1 at its border, and their depths.
struct Reach {
  double nearest = 1e300, farthest = -1e300, left = -1e300, right = -1e300, bottom = -1e300, top = -1e300;
};

Reach reach_of(const std::vector<Vec3>& points, const Camera& camera, double aspect) {
  const Vec3 f = glm::normalize(camera.target - camera.eye), r = glm::normalize(glm::cross(f, camera.up)),
             u = glm::cross(r, f);
  const double half = std::tan(camera.fov_y_degrees * testing::kPi / 360.0);
  Reach reach;
  for (const Vec3& world : points) {
    const Vec3 p = world - camera.eye;
    const double depth = glm::dot(p, f), x = glm::dot(p, r) / (depth * half * aspect),
                 y = glm::dot(p, u) / (depth * half);
    reach.nearest = std::min(reach.nearest, depth);
    reach.farthest = std::max(reach.farthest, depth);
    reach.left = std::max(reach.left, -x);
    reach.right = std::max(reach.right, x);
    reach.bottom = std::max(reach.bottom, -y);
    reach.top = std::max(reach.top, y);
  }
  return reach;
}

// A square that faces the camera and fills its height: the camera's distance is its half side over the
// frustum's.
TEST(CameraThatSees, ASquareAsNearAsItFits) {
  const std::vector<Vec3> square = {{4, 4, 7}, {6, 4, 7}, {6, 6, 7}, {4, 6, 7}};
  const Camera camera = detail::camera_that_sees(square, {0, 0, -1}, {0, 1, 0}, {0.8, 0.5});
  EXPECT_NEAR(glm::distance(camera.eye, Vec3(5, 5, 9)), 0.0, 1e-14);
  EXPECT_NEAR(glm::distance(camera.target, Vec3(5, 5, 7)), 0.0, 1e-14);
  EXPECT_NEAR(std::tan(camera.fov_y_degrees * testing::kPi / 360.0), 0.5, 1e-15);
}

// One pair of sides touches points at both, or else some point is as near as any may be: no camera of this
// direction that sees all is nearer.
TEST(CameraThatSees, TouchesPointsOnBothSides) {
  constexpr std::uint64_t kSeed = 71;
  Random random(kSeed);
  int wide = 0, high = 0, near = 0;
  for (int k = 0; k < 500; ++k) {
    const double size = random.spread(1e-6, 1e6);
    const Vec3 shift = 100.0 * size * random.point(),
               stretch{random.spread(0.05, 1), random.spread(0.05, 1), 1};
    std::vector<Vec3> points;
    for (int i = 0; i < 30; ++i) points.push_back(shift + size * stretch * random.point());
    const double half = random.spread(0.1, 2.0), aspect = random.spread(0.3, 3.0);
    Vec3 forward = random.direction();
    forward.y *= 0.7;
    const Camera camera = detail::camera_that_sees(points, forward, {0, 1, 0}, {aspect * half, half});
    const Reach reach = reach_of(points, camera, aspect);
    const bool is_wide = reach.left > 1.0 - 1e-9 && reach.right > 1.0 - 1e-9;
    const bool is_high = reach.bottom > 1.0 - 1e-9 && reach.top > 1.0 - 1e-9;
    const bool is_near =
        std::abs(reach.nearest - 0.5 * (reach.farthest - reach.nearest)) < 1e-9 * reach.farthest;
    ASSERT_TRUE(is_wide || is_high || is_near) << "seed " << kSeed << ", case " << k;
    ASSERT_GT(reach.nearest, (0.5 - 1e-9) * (reach.farthest - reach.nearest)) << k;
    ASSERT_LT(std::max({reach.left, reach.right, reach.bottom, reach.top}), 1.0 + 1e-9) << k;
    wide += is_wide;
    high += is_high;
    near += is_near;
  }
  EXPECT_GT(wide, 100);
  EXPECT_GT(high, 50);
  EXPECT_GT(near, 10);
}

}  // namespace
}  // namespace penumbra
