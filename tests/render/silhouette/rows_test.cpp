// Rows swept in vectors against rows sorted one by one.
#include "render/silhouette/areas/rows.h"

#include <gtest/gtest.h>

#include "tests/render/render_support.h"
#include "tests/render/silhouette/random_segments.h"

namespace penumbra::detail {
namespace {

using penumbra::testing::Random;
using penumbra::testing::random_horizon;
using penumbra::testing::random_polygons;

TEST(Rows, VectorsAgreeWithRowsSortedSingly) {
  Random random(19);
  Rows together, singly;
  for (int i = 0; i < 200; ++i) {
    const DiskPart part(i % 2 == 0 ? no_horizon() : random_horizon(random));
    const std::vector<Segment> segments = random_polygons(random, 1 + i % 60);
    ClippedSegments clipped;
    clip_segments(segments, 0, part, clipped);
    const int rows = 4 + i % 90;
    const RowSums a = together.sweep(clipped, part, rows), b = singly.sweep_singly(clipped, part, rows);
    ASSERT_EQ(a.length, b.length);
    ASSERT_EQ(a.first, b.first);
    ASSERT_EQ(a.second, b.second);
    ASSERT_EQ(a.lowest, b.lowest);
    ASSERT_EQ(a.lowest_length, b.lowest_length);
    ASSERT_EQ(a.complexities, b.complexities);
    for (int k = 0; k < 2; ++k) ASSERT_EQ(a.aims[k], b.aims[k]);
  }
}

}  // namespace
}  // namespace penumbra::detail
