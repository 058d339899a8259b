// Sides of planes in float, near the planes and far from the origin.
#include "render/silhouette/edges/plane_lanes.h"

#include <gtest/gtest.h>

#include "tests/render/render_support.h"

namespace penumbra::detail {
namespace {

using penumbra::testing::Random;

/// However near a point lies to a plane, and both far from the origin.
TEST(LocalPlanes, DismissOnlyEdgesWithBothFacesOnOneSide) {
  Random random(79);
  std::size_t dismissed = 0, near = 0, known = 0;
  for (int round = 0; round < 20000; ++round) {
    LocalPlanes block;
    const Vec3 place = random.point();
    block.origin = FloatBox(place, Vec3(0.0)).middle;
    const Vec3 x = place + random.spread(1e-6, 4.0) * random.direction();
    std::array<BandEdge, kFloatLanes> edges;
    for (std::size_t lane = 0; lane < kFloatLanes; ++lane) {
      BandEdge& e = edges[lane];
      for (FacePlane* plane : {&e.left, &e.right}) {
        const Vec3 normal = random.direction();
        const double off = random.spread(1e-14, 1.0) * (random.uniform(0, 1) < 0.5 ? -1.0 : 1.0);
        *plane = {normal, off - glm::dot(normal, x), 0x1p-44};
      }
      if (round % 5 == 0) e.right = kNoFace;
      block.set(lane, e);
    }
    const std::uint32_t kept = may_be_silhouettes(block, SplitPoint(x));
    for (std::size_t lane = 0; lane < kFloatLanes; ++lane) {
      const double left = edges[lane].left.value(x), right = edges[lane].right.value(x);
      const double nearest = std::min(std::abs(left), std::abs(right));
      const bool same = edges[lane].has_right() && (left > 0.0) == (right > 0.0);
      if (!(kept >> lane & 1)) {
        ++dismissed;
        near += nearest < 1e-6 ? 1 : 0;
        ASSERT_TRUE(same) << left << " " << right;
      } else if (same && nearest > 1e-5 * (1.0 + glm::distance(x, place))) {
        ADD_FAILURE() << "not known: " << left << " " << right;
      }
      known += same ? 1 : 0;
    }
  }
  EXPECT_GT(near, 5000u) << "of " << dismissed << ", of " << known << " that might be";
}

}  // namespace
}  // namespace penumbra::detail
