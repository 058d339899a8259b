// Blinds, gratings and moirés against columns. `./run yardstick patterns` looks at more of them.
#include "tests/render/silhouette/areas/regular_patterns.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "render/silhouette/areas/visible_area.h"
#include "tests/render/silhouette/areas/area_by_columns.h"

namespace penumbra::detail {
namespace {

using penumbra::testing::AreaByColumns;
using penumbra::testing::kPi;
using penumbra::testing::RegularPattern;

/// V as the method would have it: rays to the aims tell whether anything is visible.
double seen(const RegularPattern& pattern, VisibleArea& visible_area, bool& resolved) {
  const DiskPart part(pattern.horizon);
  ClippedSegments clipped;
  clip_segments(pattern.segments, 0, part, clipped);
  VisibleAreaResult out;
  visible_area.compute(clipped, part, 64, 0.0, out);
  resolved = out.resolved;
  const bool is_free = std::ranges::any_of(out.aims, [&](const glm::dvec2& aim) {
    return penumbra::testing::faces_over(pattern.segments, aim) == 0;
  });
  return is_free ? out.area / kPi : 0.0;
}

TEST(RegularPatterns, AreasHoldAgainstColumns) {
  VisibleArea visible_area;
  double squares = 0.0, most = 0.0;
  int unresolved = 0;
  constexpr int kPatterns = 120;
  for (int i = 0; i < kPatterns; ++i) {
    const RegularPattern pattern = penumbra::testing::regular_pattern(i, 250);
    bool resolved = false;
    const double error =
        seen(pattern, visible_area, resolved) -
        AreaByColumns(pattern.segments, pattern.horizon.normal, pattern.horizon.delta).visible();
    EXPECT_LE(std::abs(error), 0.03) << pattern.kind << ' ' << i;
    squares += error * error;
    most = std::max(most, std::abs(error));
    unresolved += resolved ? 0 : 1;
  }
  const double rmse = std::sqrt(squares / kPatterns);
  std::printf("%d patterns: RMSE %.5f, at most %.4f, unresolved %d\n", kPatterns, rmse, most, unresolved);
  EXPECT_LE(rmse, 0.0015);
  EXPECT_EQ(unresolved, 0);
}

/// A grating that moves: V follows without a jump, whatever way finds it.
TEST(RegularPatterns, MotionDoesNotFlicker) {
  VisibleArea visible_area;
  const auto grating = [](double degrees, double period, double phase, std::vector<Segment>& out) {
    const double c = std::cos(degrees * kPi / 180.0), s = std::sin(degrees * kPi / 180.0);
    const auto at = [&](double x, double y) { return glm::dvec2(c * x - s * y, s * x + c * y); };
    for (int k = -40; k <= 40; ++k) {
      const double y = (k + phase) * period;
      const glm::dvec2 corners[] = {at(-2, y), at(2, y), at(2, y + 0.4 * period), at(-2, y + 0.4 * period)};
      for (int e = 0; e < 4; ++e) out.push_back({corners[e], corners[(e + 1) % 4], 2});
    }
  };
  double worst = 0.0, before = 0.0;
  for (int step = 0; step < 20; ++step) {
    RegularPattern pattern;
    grating(0.3, 2.0 / 48.0, step / 20.0, pattern.segments);
    grating(-0.4, 2.0 / 47.0, 0.3, pattern.segments);
    bool resolved = false;
    const double error =
        seen(pattern, visible_area, resolved) - AreaByColumns(pattern.segments, {0, 0}, 1).visible();
    if (step > 0) worst = std::max(worst, std::abs(error - before));
    before = error;
  }
  EXPECT_LE(worst, 0.003);
}

}  // namespace
}  // namespace penumbra::detail
