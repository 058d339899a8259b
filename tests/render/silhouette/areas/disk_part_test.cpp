// The boundary of what a horizon leaves of the disk.
#include "render/silhouette/areas/disk_part.h"

#include <gtest/gtest.h>

#include "tests/render/render_support.h"
#include "tests/render/silhouette/areas/random_segments.h"

namespace penumbra::detail {
namespace {

using glm::dvec2;
using penumbra::testing::Random;

TEST(DiskPart, WalksItsBoundary) {
  Random random(5);
  for (int i = 0; i < 400; ++i) {
    const DiskPart part(i % 4 == 0 ? no_horizon() : testing::random_horizon(random));
    // Around D in small steps from the lowest point, by its ends at rising and falling heights.
    const int n = 4000;
    dvec2 last{0.0};
    double sum = 0.0, off = 0.0;
    bool started = false;
    const auto step = [&](const dvec2& p, bool left) {
      if (started) sum += 0.5 * (last.x * p.y - last.y * p.x);
      started = true;
      last = p;
      const bool chord = part.is_cut() && std::abs(height(part.horizon(), p)) < 1e-9;
      const Event e{p, chord, 1};
      if (part.on_left(e) == left) off = std::max(off, std::abs(part.walked(e) - sum));
    };
    const auto at = [&](int k) {
      return part.bottom() + (part.top() - part.bottom()) * 0.5 * (1.0 - std::cos(testing::kPi * k / n));
    };
    for (int k = 1; k < n; ++k) {
      const auto [left, right] = part.span(at(k), DiskPart::half_width(at(k)));
      if (k == 1) {
        const double low = part.bottom();
        last = {part.span(low, DiskPart::half_width(low)).second, low};
        started = true;
      }
      step({right, at(k)}, false);
    }
    for (int k = n - 1; k > 0; --k) step({part.span(at(k), DiskPart::half_width(at(k))).first, at(k)}, true);
    EXPECT_NEAR(sum, part.area(), 2e-3) << i;
    EXPECT_LE(off, 2e-3) << i;
  }
}

}  // namespace
}  // namespace penumbra::detail
