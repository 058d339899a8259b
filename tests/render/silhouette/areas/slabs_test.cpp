// The exact sweep against columns (area_by_columns.h) and against the integral of L; degenerate segments.
#include "render/silhouette/areas/slabs.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/render/render_support.h"
#include "tests/render/silhouette/areas/area_by_columns.h"
#include "tests/render/silhouette/areas/random_segments.h"
#include "tests/render/silhouette/areas/regular_patterns.h"

namespace penumbra::detail {
namespace {

using glm::dvec2;
using penumbra::testing::AreaByColumns;
using penumbra::testing::faces_over;
using penumbra::testing::kPi;
using penumbra::testing::Random;
using penumbra::testing::random_horizon;
using penumbra::testing::random_polygons;

constexpr std::size_t kAny = std::numeric_limits<std::size_t>::max() / 4;
/// Ends of intervals are multiples of 2^-26; some hundred intervals at a height err by as much as chance adds
/// up.
constexpr double kPositions = 3e-7;

struct Swept {
  ClippedSegments clipped;
  LineSums sums;
};

Swept sweep(const std::vector<Segment>& segments, const Chord& horizon) {
  Swept out;
  const DiskPart part(horizon);
  clip_segments(segments, 0, part, out.clipped);
  Slabs slabs;
  EXPECT_TRUE(slabs.find(out.clipped, part, kAny));
  out.sums = slabs.sweep(out.clipped, part);
  EXPECT_NEAR(out.sums.area, part.area(), kPositions);
  EXPECT_NEAR(out.sums.first, out.clipped.integral, kPositions * (1.0 + out.clipped.segments.size() / 10.0));
  return out;
}

/// V: a ray to the first aim tells whether anything is visible.
double visible(const Swept& swept, const std::vector<Segment>& segments) {
  const auto& aims = swept.sums.aims;
  const dvec2 aim = aims[0].room < aims[1].room ? aims[1].at : aims[0].at;
  return faces_over(segments, aim) == 0 ? swept.sums.lowest_area / kPi : 0.0;
}

TEST(Slabs, AgreeWithColumnsOnPolygons) {
  Random random(31);
  for (int i = 0; i < 200; ++i) {
    const Chord horizon = i % 2 == 0 ? no_horizon() : random_horizon(random);
    const std::vector<Segment> segments = random_polygons(random, 1 + i % 20);
    const Swept swept = sweep(segments, horizon);
    if (swept.clipped.segments.empty()) continue;
    EXPECT_NEAR(visible(swept, segments), AreaByColumns(segments, horizon.normal, horizon.delta).visible(),
                kPositions)
        << i;
  }
}

TEST(Slabs, AgreeWithColumnsOnRegularPatterns) {
  for (int i = 0; i < 30; ++i) {
    const auto pattern = penumbra::testing::regular_pattern(i, 250);
    const Swept swept = sweep(pattern.segments, pattern.horizon);
    EXPECT_NEAR(visible(swept, pattern.segments),
                AreaByColumns(pattern.segments, pattern.horizon.normal, pattern.horizon.delta).visible(),
                kPositions)
        << pattern.kind << ' ' << i;
  }
}

/// Outlines that lie on each other, level edges, ends at one height, an end on another segment.
TEST(Slabs, DegenerateOutlinesAreExact) {
  const auto outline = [](std::vector<Segment>& out, const std::vector<dvec2>& corners) {
    for (std::size_t k = 0; k < corners.size(); ++k)
      out.push_back({corners[k], corners[(k + 1) % corners.size()], 2});
  };
  std::vector<Segment> segments;
  const std::vector<dvec2> square{{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}};
  for (int copies = 0; copies < 3; ++copies) outline(segments, square);
  outline(segments, {{0.5, -0.5}, {0.7, -0.5}, {0.7, 0.5}, {0.5, 0.5}});  // beside it, an edge in common
  outline(segments, {{-0.5, 0.5}, {0.0, 0.5}, {0.0, 0.8}});               // an end within its edge
  outline(segments, {{-0.2, -0.2}, {0.2, 0.2}, {-0.2, 0.2}});             // along its diagonal
  const Swept swept = sweep(segments, no_horizon());
  EXPECT_NEAR(swept.sums.lowest_area, kPi - 1.0 - 0.2 - 0.075, kPositions);
  EXPECT_NEAR(visible(swept, segments), AreaByColumns(segments, {0, 0}, 1).visible(), kPositions);
}

TEST(Slabs, MoreThanAllowedAreNotSwept) {
  Random random(32);
  ClippedSegments clipped;
  const DiskPart part(no_horizon());
  clip_segments(random_polygons(random, 40), 0, part, clipped);
  Slabs slabs;
  EXPECT_FALSE(slabs.find(clipped, part, 10));
  EXPECT_FALSE(slabs.find(clipped, part, clipped.segments.size()));
  ASSERT_TRUE(slabs.find(clipped, part, kAny));
  EXPECT_NEAR(slabs.sweep(clipped, part).area, part.area(), kPositions);
}

}  // namespace
}  // namespace penumbra::detail
