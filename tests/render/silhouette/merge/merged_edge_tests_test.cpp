// Merged edges that floats dismiss, by points beside them.
#include "render/silhouette/collect/merged_edge_tests.h"

#include <gtest/gtest.h>

#include "tests/render/render_support.h"

namespace penumbra::detail {
namespace {

using penumbra::testing::Random;

/// What floats dismiss is beside the disk for every receiver, with all that is within the margin.
TEST(MergedEdgeTests, DismissOnlyWhatIsBesideTheDisk) {
  Random random(78);
  const double extent = 30.0;
  std::size_t dismissed = 0, dismissed_for_all = 0, kept = 0;
  for (int round = 0; round < 3000; ++round) {
    MergedBlock block;
    block.count = 1 + static_cast<std::size_t>(round) % MergedBlock::kEdges;
    for (std::size_t k = 0; k < block.count; ++k) {
      const Vec3 at{random.uniform(-4, 4), random.uniform(-4, 4), random.uniform(0.5, 12)};
      const FacePlane plane{Vec3(0, 0, 1), 0.0, 0.0};
      block.edges[k] = {at, at + random.spread(0.01, 3.0) * random.direction(), plane, plane};
      block.sides[k].margin = random.spread(1e-6, 0.5);
      block.sides[k].left = {at + random.point(), random.spread(0.1, 3.0), 0.1, 0.1, round % 3 == 0};
    }
    std::vector<TileReceiver> receivers;
    const Vec3 place{random.uniform(-8, 8), random.uniform(-8, 8), random.uniform(6, 20)};
    for (int i = 0; i < 12; ++i) {
      TileReceiver r;
      r.x = place + random.spread(1e-3, 5.0) * random.point(), r.normal = Vec3(0, 0, -1);
      r.horizon = no_horizon();
      receivers.push_back(r);
    }
    Shaft shaft(receivers, extent);
    shaft.tighten(receivers);
    const MergedLanes lanes(block, extent);
    const std::uint32_t for_all = may_be_across(lanes, FloatShaft(shaft, extent));
    EXPECT_EQ(for_all >> block.count, 0u);
    for (const TileReceiver& r : receivers) {
      const std::uint32_t for_one = may_be_across(lanes, FloatEye(r, {}, extent));
      for (std::size_t k = 0; k < block.count; ++k) {
        const bool is_dismissed = !((for_all & for_one) >> k & 1);
        (is_dismissed ? dismissed : kept) += 1;
        dismissed_for_all += !(for_all >> k & 1);
        if (!is_dismissed) continue;
        const auto& [left, right, margin, middle, half] = block.sides[k];
        ASSERT_TRUE(left.is_flat || left.is_far(r.x));
        for (int point = 0; point < 8; ++point) {
          const double t = point == 0 ? 0.0 : point == 1 ? 1.0 : random.uniform(0, 1);
          const Vec3 p = block.edges[k].a + t * (block.edges[k].b - block.edges[k].a) +
                         0.999 * margin * random.direction();
          if (!(p.z < r.x.z) || !(p.z > 0.0)) continue;
          const glm::dvec2 seen = glm::dvec2(r.x) + glm::dvec2(p - r.x) * (r.x.z / (r.x.z - p.z));
          ASSERT_GT(glm::dot(seen, seen), 1.0) << round;
        }
      }
    }
  }
  EXPECT_GT(dismissed_for_all, 20000u);
  EXPECT_GT(dismissed, dismissed_for_all + 1000);
  EXPECT_GT(kept, 5000u);
}

}  // namespace
}  // namespace penumbra::detail
