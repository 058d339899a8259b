// Slabs, rows and the closed form against each other and against counted points; slivers.
#include "render/silhouette/areas/visible_area.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "tests/render/render_support.h"
#include "tests/render/silhouette/areas/random_segments.h"

namespace penumbra::detail {
namespace {

using glm::dvec2;
using penumbra::testing::Random;
using penumbra::testing::random_horizon;
using penumbra::testing::random_polygons;
using penumbra::testing::winding;

TEST(VisibleArea, SlabsAndManyRowsAgreeWithPointCounts) {
  Random random(17);
  VisibleArea visible_area;
  double worst_rows = 0.0, worst_points = 0.0;
  for (int i = 0; i < 300; ++i) {
    const DiskPart part(i % 2 == 0 ? no_horizon() : random_horizon(random));
    const std::vector<Segment> segments = random_polygons(random, 1 + i % 4);
    ClippedSegments clipped;
    clip_segments(segments, 0, part, clipped);
    ASSERT_TRUE(clipped.closed);
    if (clipped.segments.empty()) continue;
    const VisibleAreaResult slabs = visible_area.by_slabs(clipped, part),
                            rows = visible_area.by_rows(clipped, part, 1024);
    worst_rows = std::max(worst_rows, std::abs(slabs.area - rows.area));
    // The lowest level by counting points.
    std::map<int, int> counts;
    const int n = 200;
    for (int y = 0; y < n; ++y)
      for (int x = 0; x < n; ++x) {
        const dvec2 p{2.0 * (x + 0.5) / n - 1.0, 2.0 * (y + 0.5) / n - 1.0};
        if (glm::dot(p, p) < 1.0 && height(part.horizon(), p) > 0.0) ++counts[winding(segments, p)];
      }
    const double counted = counts.begin()->second * 4.0 / (n * n);
    // Neither a depth complexity too small for points, nor one that points miss.
    if (counts.begin()->second > 20 && slabs.area > 0.02)
      worst_points = std::max(worst_points, std::abs(slabs.area - counted));
    for (const dvec2& aim : slabs.aims) {
      EXPECT_LT(glm::dot(aim, aim), 1.0);
      EXPECT_GE(height(part.horizon(), aim), -1e-9);
    }
    VisibleAreaResult chain;
    if (area_by_chain(clipped, part, 0.0, chain)) {
      EXPECT_NEAR(chain.area, slabs.area, 1e-7) << i << ": lengths in slabs are multiples of 2^-26";
    }
  }
  std::printf("slabs against 1,024 rows %.2g, against counted points %.2g\n", worst_rows, worst_points);
  EXPECT_LE(worst_rows, 2e-4);
  EXPECT_LE(worst_points, 0.02) << "cells of 1/100 along boundaries of length below 20";
}

TEST(VisibleArea, WhatLiesBetweenRowsIsFound) {
  // A triangle over half of the disk, and thirty strips on top of each other between two of 64 rows.
  std::vector<Segment> segments;
  const auto outline = [&](std::vector<dvec2> corners) {
    for (std::size_t k = 0; k < corners.size(); ++k)
      segments.push_back({corners[k], corners[(k + 1) % corners.size()], 2});
  };
  outline({{-0.8, -0.5}, {0.7, -0.6}, {0.1, 0.7}});
  for (int k = 0; k < 30; ++k)
    outline({{-0.9 + 0.001 * k, -0.006}, {0.9, -0.0055}, {0.9, 0.0055}, {-0.9 + 0.001 * k, 0.006}});
  const DiskPart part(no_horizon());
  ClippedSegments clipped;
  clip_segments(segments, 0, part, clipped);
  VisibleArea visible_area;
  const double exact = visible_area.by_slabs(clipped, part).area;
  EXPECT_NEAR(visible_area.by_rows(clipped, part, 64).area, exact, 1e-6);
}

/// Whatever rows meet is one depth complexity, and the integral of L says that there is more.
TEST(VisibleArea, WhatEveryRowMissesIsFound) {
  const RowHeights heights(64, 0);
  for (const double thick :
       {1e-3, 0.5}) {  // slats, or all but slits, between the rows, in shares of their distance
    std::vector<Segment> segments;
    for (int k = 0; k < 63; ++k) {
      const double a = 2.0 * heights.row(k) - 1.0, b = 2.0 * heights.row(k + 1) - 1.0, gap = b - a;
      const double low = a + 0.4 * gap, high = low + thick * gap;
      const dvec2 corners[] = {{-0.9, low}, {0.9, low}, {0.9, high}, {-0.9, high}};
      for (int e = 0; e < 4; ++e) segments.push_back({corners[e], corners[(e + 1) % 4], 2});
    }
    const DiskPart part(no_horizon());
    ClippedSegments clipped;
    clip_segments(segments, 0, part, clipped);
    VisibleArea visible_area;
    VisibleAreaResult out;
    visible_area.compute(clipped, part, 64, 0.0, out);
    EXPECT_NEAR(out.area, part.area() - clipped.integral / 2.0, 1e-6) << thick;
    EXPECT_EQ(out.complexities, 2);
    EXPECT_TRUE(out.resolved);
  }
}

/// Slats along the rows of both families, finer than the most rows are: slabs are too many as well.
TEST(VisibleArea, WhatIsNotResolvedIsSaid) {
  std::vector<Segment> segments;
  const auto layer = [&](double angle, double period, int count) {
    const dvec2 along{std::cos(angle), std::sin(angle)}, across{-along.y, along.x};
    for (int k = -count; k < count; ++k) {
      const dvec2 low = k * period * across, high = (k + 0.5) * period * across;
      const dvec2 corners[] = {low - 2.0 * along, low + 2.0 * along, high + 2.0 * along, high - 2.0 * along};
      for (int e = 0; e < 4; ++e) segments.push_back({corners[e], corners[(e + 1) % 4], 2});
    }
  };
  layer(0.0002, 2.0 / 1000.0, 500);
  layer(0.0002 - 1.24, 2.0 / 1000.0, 500);
  const DiskPart part(no_horizon());
  ClippedSegments clipped;
  clip_segments(segments, 0, part, clipped);
  VisibleArea visible_area;
  VisibleAreaResult out;
  visible_area.compute(clipped, part, 64, 0.0, out);
  EXPECT_EQ(out.method, AreaMethod::kRows);
  EXPECT_FALSE(out.resolved);
  EXPECT_NEAR(out.area / part.area(), 0.25, 0.01);
}

/// Silhouettes of merged faces turn back here and there: tiny loops the wrong way round, at a depth
/// complexity below all.
TEST(VisibleArea, SliversBelowTheLowestDepthComplexityCountForNothing) {
  Random random(20);
  const auto outline = [](std::vector<Segment>& out, const std::vector<dvec2>& corners, int jump) {
    for (std::size_t k = 0; k < corners.size(); ++k)
      out.push_back({corners[k], corners[(k + 1) % corners.size()], jump});
  };
  VisibleArea visible_area;
  for (int i = 0; i < 100; ++i) {
    const DiskPart part(i % 2 == 0 ? no_horizon() : random_horizon(random));
    std::vector<Segment> segments;
    const dvec2 d = random.unit2(), side{-d.y, d.x}, foot = random.uniform(-0.6, 0.6) * side;
    outline(segments, {foot - 9.0 * d, foot + 9.0 * d, foot + 9.0 * (d + side), foot - 9.0 * (d - side)}, 2);
    ClippedSegments whole;
    clip_segments(segments, 0, part, whole);
    if (!whole.closed || whole.segments.empty()) continue;
    const double exact = visible_area.by_slabs(whole, part).area;
    if (exact <= 1e-3 * part.area()) continue;  // a sliver itself
    const int slivers = 1 + i % 9;
    for (int k = 0; k < slivers; ++k) {
      const dvec2 at = foot + random.uniform(-0.7, 0.7) * d + random.uniform(-0.02, 0.02) * side;
      outline(segments, {at, at + 0.02 * d, at + 0.02 * d + 0.002 * side}, -2);
    }
    ClippedSegments clipped;
    clip_segments(segments, 0, part, clipped);
    VisibleAreaResult result;
    visible_area.compute(clipped, part, 64, 1e-3, result);
    EXPECT_NEAR(result.area, exact, 1e-3) << i;
    EXPECT_NEAR(visible_area.by_slabs(clipped, part, 1e-3).area, exact, 1e-3) << i;
    EXPECT_NEAR(visible_area.by_rows(clipped, part, 64, 1e-3).area, exact, 2e-3) << i;
    if (visible_area.by_few_rows(clipped, part, 1e-3, result)) {
      EXPECT_NEAR(result.area, exact, 1e-3) << i;
    }
  }
}

/// A second caster within the first's shadow is no sliver, wherever it lies between few rows.
TEST(VisibleArea, FewRowsDoNotMistakeOverlapForTwoDepthComplexities) {
  Random random(24);
  VisibleArea visible_area;
  for (int i = 0; i < 300; ++i) {
    const DiskPart part(no_horizon());
    std::vector<Segment> segments = random_polygons(random, 2 + i % 3);
    ClippedSegments clipped;
    clip_segments(segments, 0, part, clipped);
    if (!clipped.closed || clipped.segments.empty()) continue;
    VisibleAreaResult few;
    if (visible_area.by_few_rows(clipped, part, 1e-3, few)) {
      EXPECT_NEAR(few.area, visible_area.by_slabs(clipped, part).area, 0.02) << i;
    }
  }
}

}  // namespace
}  // namespace penumbra::detail
