// The integral of one chord, and folds of chains.
#include "render/silhouette/areas/clip_segments.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "render/silhouette/areas/visible_area.h"
#include "tests/render/render_support.h"
#include "tests/render/silhouette/areas/random_segments.h"

namespace penumbra::detail {
namespace {

using glm::dvec2;
using penumbra::testing::Random;
using penumbra::testing::winding;

TEST(ClippedSegments, IsExactForOneChord) {
  Random random(23);
  for (int i = 0; i < 500; ++i) {
    const Chord chord{random.unit2(), random.uniform(-0.99, 0.99)};
    const dvec2 foot = -chord.delta * chord.normal, d{chord.normal.y, -chord.normal.x};
    // A band of faces beyond the chord, ends far outside of the disk.
    const double reach = random.spread(3.0, 1e7);
    const std::vector<Segment> segments{{foot - reach * d, foot + reach * d, -1}};
    const DiskPart part(no_horizon());
    ClippedSegments clipped;
    clip_segments(segments, 0, part, clipped);
    VisibleAreaResult out;
    if (!area_by_chain(clipped, part, 0.0, out)) continue;  // too near the rim for a ray
    EXPECT_NEAR(out.area / testing::kPi, half_plane_area(chord.delta), 1e-9) << i;
  }
}

/// A chain across the disk that turns back or makes a loop here and there, closed far below.
std::vector<Segment> folded_chain(Random& random) {
  std::vector<dvec2> corners;
  const double bend = random.uniform(-0.3, 0.3), back = random.spread(0.01, 0.3);
  for (double x = -1.5; x < 1.5; x += random.uniform(0.02, 0.2)) {
    corners.push_back({x, bend * x * x + random.uniform(-0.01, 0.01)});
    if (random.uniform(0, 1) < 0.3)
      corners.push_back({x - random.uniform(0, back), bend * x * x + random.uniform(-back, back)});
    if (random.uniform(0, 1) < 0.1) {
      const dvec2 p = corners.back();
      const double high = random.uniform(-back, back);
      for (const dvec2& step : {dvec2(back, 0), dvec2(back, high), dvec2(0, high), dvec2(0, 0)})
        corners.push_back(p + step);
    }
  }
  corners.push_back({3.0, bend}), corners.push_back({3.0, -9.0}), corners.push_back({-3.0, -9.0});
  const dvec2 turn = random.unit2();
  std::vector<Segment> out;
  const auto corner = [&](std::size_t k) {
    const dvec2& p = corners[k % corners.size()];
    return dvec2(turn.x * p.x - turn.y * p.y, turn.y * p.x + turn.x * p.y);
  };
  for (std::size_t k = 0; k < corners.size(); ++k) out.push_back({corner(k + 1), corner(k), 2});
  std::rotate(out.begin(), out.begin() + static_cast<long>(random.uniform(0, 1) * 9), out.end());
  return out;
}

TEST(ClippedSegments, FoldsOfAChainTakeUpNoMoreThanTheyMay) {
  Random random(24);
  const DiskPart part(no_horizon());
  std::size_t chains = 0, folded = 0;
  double tightest = 0.0;
  for (int i = 0; i < 600; ++i) {
    const std::vector<Segment> segments = folded_chain(random);
    ClippedSegments clipped;
    clip_segments(segments, 0, part, clipped);
    ASSERT_TRUE(clipped.closed);
    if (is_one_chain(clipped) || !is_one_chain(clipped, 0.5)) continue;
    double least = 0.0, enough = 0.5;  // of folds to allow
    for (int step = 0; step < 20; ++step) {
      const double middle = 0.5 * (least + enough);
      (is_one_chain(clipped, middle) ? enough : least) = middle;
    }
    ++chains;
    std::size_t others = 0;
    const int n = 200;
    for (int y = 0; y < n; ++y)
      for (int x = 0; x < n; ++x) {
        const dvec2 p{2.0 * (x + 0.5) / n - 1.0, 2.0 * (y + 0.5) / n - 1.0};
        const int complexity = winding(segments, p);
        others += glm::dot(p, p) < 1.0 && complexity != 0 && complexity != 1 ? 1 : 0;
      }
    const double area = static_cast<double>(others) * 4.0 / (n * n);
    folded += area > 0.0 ? 1 : 0;
    EXPECT_LE(area, enough + 5e-4) << i;
    tightest = std::max(tightest, area / enough);
  }
  EXPECT_GT(folded, 40u) << "of " << chains;
  EXPECT_GT(tightest, 0.3) << "or the bound says little";
}

}  // namespace
}  // namespace penumbra::detail
