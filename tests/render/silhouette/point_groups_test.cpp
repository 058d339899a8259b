// Boxes in the light's frame, by all points.
#include "render/silhouette/edges/point_groups.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/render/render_support.h"

namespace penumbra::detail {
namespace {

using penumbra::testing::Random;

TEST(PointGroups, HaveTheBoxOfAllPoints) {
  Random random(80);
  for (int round = 0; round < 200; ++round) {
    const Vec3 middle = round % 3 == 0 ? 1e6 * random.point() : random.point();
    const double size = random.spread(1e-3, 1e3);
    std::vector<Vec3> points;
    for (int i = 0; i < 1 + 37 * round; ++i) {
      const Vec3 p = round % 2 == 0 ? random.direction() : random.point();
      points.push_back(middle + size * p);
    }
    if (round % 4 == 0)  // neighbors in a row
      std::ranges::sort(points, {}, [](const Vec3& p) { return p.x; });
    const UnitLight light(
        DiskLight{middle + 5.0 * size * random.point(), random.direction(), size * random.spread(1e-3, 1.0)});
    Bounds box;
    for (const Vec3& p : points) box.add(light.point(p));
    const Bounds found = PointGroups(points).box_in(light);
    ASSERT_EQ(found.low, box.low) << round;
    ASSERT_EQ(found.high, box.high) << round;
  }
}

}  // namespace
}  // namespace penumbra::detail
