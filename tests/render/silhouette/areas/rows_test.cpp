// Rows swept in vectors against rows sorted one by one; directions against each other and the integral.
#include "render/silhouette/areas/rows.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/render/render_support.h"
#include "tests/render/silhouette/areas/random_segments.h"

namespace penumbra::detail {
namespace {

using penumbra::testing::Random;
using penumbra::testing::random_horizon;
using penumbra::testing::random_polygons;

Turn turn_by(double angle) {
  return {std::cos(angle), std::sin(angle)};
}

ClippedSegments clipped_polygons(Random& random, int count, const DiskPart& part) {
  ClippedSegments clipped;
  clip_segments(random_polygons(random, count), 0, part, clipped);
  return clipped;
}

TEST(Rows, VectorsAgreeWithRowsSortedSingly) {
  Random random(19);
  RowMemory memory;
  for (int i = 0; i < 200; ++i) {
    Rows together(turn_by(i), i % 2), singly(turn_by(i), i % 2);
    const DiskPart part(i % 2 == 0 ? no_horizon() : random_horizon(random));
    const ClippedSegments clipped = clipped_polygons(random, 1 + i % 60, part);
    const int rows = 4 + i % 190;
    const LineSums a = together.sweep(clipped, part, rows, memory),
                   b = singly.sweep_singly(clipped, part, rows, memory);
    ASSERT_EQ(a.area, b.area);
    ASSERT_EQ(a.first, b.first);
    ASSERT_EQ(a.second, b.second);
    ASSERT_EQ(a.lowest, b.lowest);
    ASSERT_EQ(a.lowest_area, b.lowest_area);
    ASSERT_EQ(a.met, b.met);
    for (int k = 0; k < 2; ++k) ASSERT_EQ(a.aims[k].at, b.aims[k].at);
  }
}

TEST(Rows, OtherReceiversBetweenChangeNothing) {
  Random random(20);
  RowMemory memory, fresh_memory;
  Rows kept(turn_by(0.7), 0);
  for (int i = 0; i < 100; ++i) {
    const DiskPart part(i % 3 == 0 ? random_horizon(random) : no_horizon());
    const ClippedSegments clipped = clipped_polygons(random, 1 + i % 40, part);
    Rows fresh(turn_by(0.7), 0);
    const int rows = i % 5 == 0 ? 48 : 64;
    ASSERT_EQ(kept.sweep(clipped, part, rows, memory).first,
              fresh.sweep(clipped, part, rows, fresh_memory).first);
  }
}

/// L is relative to D's lowest point whatever the direction is.
TEST(Rows, AllDirectionsAgreeWithTheIntegral) {
  Random random(21);
  RowMemory memory;
  double worst = 0.0;
  for (int i = 0; i < 300; ++i) {
    const DiskPart part(i % 2 == 0 ? no_horizon() : random_horizon(random));
    const ClippedSegments clipped = clipped_polygons(random, 1 + i % 5, part);
    ASSERT_TRUE(clipped.closed);
    const double angle = random.uniform(-4, 4);
    Rows rows(turn_by(angle), 0);
    const LineSums sums = rows.sweep(clipped, part, 1024, memory);
    EXPECT_NEAR(sums.area, part.area(), part.is_cut() ? 1e-4 : 1e-6)
        << "strips with a corner of D are not exact";
    worst = std::max(worst, std::abs(sums.first - clipped.integral));
  }
  EXPECT_LT(worst, 0.01) << "with another origin of L it is a multiple of the area";
}

TEST(Rows, ManySegmentsAreSweptInPieces) {
  Random random(22);
  RowMemory memory;
  Rows rows({}, 0);
  const DiskPart part(no_horizon());
  const ClippedSegments clipped = clipped_polygons(random, 900, part);
  ASSERT_GT(clipped.segments.size(), 2000u);
  const LineSums sums = rows.sweep(clipped, part, 64, memory),
                 singly = rows.sweep_singly(clipped, part, 64, memory);
  EXPECT_EQ(sums.first, singly.first);
  EXPECT_NEAR(sums.first, clipped.integral, 0.01 * std::abs(clipped.integral));
}

}  // namespace
}  // namespace penumbra::detail
