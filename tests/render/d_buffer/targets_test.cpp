#include "render/d_buffer/view/targets.h"

#include <gtest/gtest.h>

#include <glm/matrix.hpp>

#include "tests/render/render_support.h"

namespace penumbra {
namespace {

using testing::Random;

TEST(ChooseTargets, OneWindowWhereItFitsElseFiveSides) {
  const detail::UvBounds narrow{{-0.5, 0.25}, {1.0, detail::kWidestWindow}};
  EXPECT_FALSE(detail::needs_hemicube(narrow));
  const detail::Target one = detail::one_target(narrow, 104);
  const double wanted[4] = {-0.545, 1.045, 0.205, detail::kWidestWindow + 0.045};  // a margin of two texels
  for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(one.window[k], wanted[k], 1e-12);
  const double wide = detail::kWidestWindow + 1e-6;
  const detail::UvBounds two_sides{{-0.5, 0.25}, {0.9, wide}}, three_sides{{-0.5, 0.25}, {1.1, wide}},
      five_sides{{-wide, -1.0}, {1.0, 1.0}}, far_from_the_axis{{1e6, -3.0}, {1e6 + 7.0, 4.0}};
  for (const auto& bounds : {two_sides, three_sides, five_sides}) EXPECT_TRUE(detail::needs_hemicube(bounds));
  EXPECT_FALSE(detail::needs_hemicube(far_from_the_axis)) << "stretched as a whole";
  EXPECT_EQ(detail::hemicube(two_sides).size(), 2u) << "front and +y";
  EXPECT_EQ(detail::hemicube(three_sides).size(), 3u) << "and +x";
  const auto five = detail::hemicube(five_sides);
  ASSERT_EQ(five.size(), 5u);
  for (const detail::Target& t : five) EXPECT_NEAR(glm::determinant(t.axes), 1.0, 1e-15) << "none mirrors";
  // Every direction in front of the light lies in exactly one side (but for borders).
  Random random(8);
  for (int k = 0; k < 1'000; ++k) {
    Vec3 d = random.direction();
    d.z = std::abs(d.z) + 1e-9;
    int hits = 0;
    for (const detail::Target& t : five) {
      const Vec3 p = t.axes * d;
      if (p.z <= 0.0) continue;
      const double u = p.x / p.z, v = p.y / p.z;
      hits += u >= t.window[0] && u < t.window[1] && v >= t.window[2] && v < t.window[3];
    }
    ASSERT_EQ(hits, 1) << d.x << " " << d.y << " " << d.z;
  }
}

}  // namespace
}  // namespace penumbra
