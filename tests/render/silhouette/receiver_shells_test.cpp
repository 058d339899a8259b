#include "render/silhouette/collect/receiver_shells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <set>

#include "tests/render/random_poses.h"

namespace penumbra::detail {
namespace {

TEST(ReceiverShells, HoldEveryGroupOnceByItsDistance) {
  testing::Random random(5);
  std::vector<Vec3> points;
  std::vector<std::int32_t> objects;
  for (int i = 0; i < 20'000; ++i) {
    points.push_back(random.spread(1e-2, 1e7) * random.direction());
    objects.push_back(i % 100 == 0 ? -1 : 0);
  }
  const Receivers receivers{.points = points, .objects = objects};
  const BoxedGroups groups(receivers);
  const Bounds casters{Vec3(-1.0), Vec3(1.0)};
  const std::vector<ReceiverShell> shells = receiver_shells(groups, casters);
  EXPECT_GT(shells.size(), 2u);
  std::set<std::uint32_t> seen;
  double reach = 0.0;
  for (const ReceiverShell& shell : shells) {
    EXPECT_TRUE(std::is_sorted(shell.groups.begin(), shell.groups.end()));
    EXPECT_GE(shell.asked_about.radius(), reach) << "outer shells come later";
    reach = shell.asked_about.radius();
    for (const std::uint32_t group : shell.groups) {
      EXPECT_TRUE(seen.insert(group).second);
      groups.groups.for_each(group, [&](std::uint32_t i) {
        if (objects[i] < 0) return;
        const Vec3& p = points[i];
        for (int k = 0; k < 3; ++k) {
          EXPECT_LE(shell.asked_about.low[k], p[k]);
          EXPECT_GE(shell.asked_about.high[k], p[k]);
        }
      });
    }
    EXPECT_LE(shell.asked_about.low.x, -1.0) << "casters are asked about in every shell";
  }
  std::size_t with_receivers = 0;
  for (std::size_t g = 0; g < groups.groups.count(); ++g) {
    bool any = false;
    groups.groups.for_each(g, [&](std::uint32_t i) { any = any || objects[i] >= 0; });
    with_receivers += any ? 1 : 0;
  }
  EXPECT_EQ(seen.size(), with_receivers);
}

TEST(ReceiverShells, AnOrdinarySceneHasOne) {
  const std::vector<Vec3> points{{0, 0, 0}, {10, 0, 10}, {-10, 0, -10}};
  const Receivers receivers{.points = points};
  EXPECT_EQ(receiver_shells(BoxedGroups(receivers), {Vec3(-0.5), Vec3(0.5)}).size(), 1u);
  EXPECT_EQ(receiver_shells(BoxedGroups(receivers), {}).size(), 1u) << "nothing casts";
}

}  // namespace
}  // namespace penumbra::detail
