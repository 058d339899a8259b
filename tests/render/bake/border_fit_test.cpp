// Texels along borders: lookups give what samples say.
#include "render/bake/border_fit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace penumbra {
namespace {

/// What is looked up: a plane.
double plane(const glm::dvec2& at) {
  return 0.3 + 0.05 * at.x - 0.02 * at.y;
}

TEST(BorderFit, ContinuesAPlaneBeyondTheBorder) {
  constexpr int kSize = 8;
  std::vector<float> channel(kSize * kSize, 0.0f);
  std::vector<std::uint32_t> unknown;
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x) {
      const auto i = static_cast<std::size_t>(y * kSize + x);
      if (x < 4) channel[i] = static_cast<float>(plane({x + 0.5, y + 0.5}));
      if (x == 4) unknown.push_back(static_cast<std::uint32_t>(i));
    }
  // Samples up to x = 4, the chart's border, which lies between two texels.
  std::vector<detail::BorderSample> samples;
  std::vector<float> values;
  for (int y = 0; y < 4 * kSize; ++y)
    for (int x = 12; x < 16; ++x) {
      const glm::dvec2 at((x + 0.5) / 4.0, (y + 0.5) / 4.0);
      samples.push_back({at, 1.0 / 16.0});
      // Beyond the centers of the outer texels a lookup is clamped.
      values.push_back(static_cast<float>(plane({at.x, std::clamp(at.y, 0.5, kSize - 0.5)})));
    }
  detail::fit_borders(kSize, kSize, samples, values, unknown, channel);
  for (const std::uint32_t i : unknown) EXPECT_NEAR(channel[i], plane({4.5, i / kSize + 0.5}), 2e-3) << i;
}

TEST(BorderFit, WithoutSamplesNothingChanges) {
  std::vector<float> channel{1, 2, 3, 4};
  detail::fit_borders(2, 2, {}, {}, {0, 3}, channel);
  EXPECT_EQ(channel, (std::vector<float>{1, 2, 3, 4}));
}

TEST(BorderFit, BilinearTexelsAreClamped) {
  const detail::BilinearTexels corner = detail::bilinear_texels(4, 4, {-3, 99});
  EXPECT_EQ(corner.index[2], 12u);
  EXPECT_EQ(corner.weight[2], 1.0);
  const detail::BilinearTexels one = detail::bilinear_texels(1, 1, {0.2, 0.7});
  for (const std::size_t i : one.index) EXPECT_EQ(i, 0u);
}

TEST(BorderFit, DilationIsARingARound) {
  std::vector<std::vector<float>> channels{std::vector<float>(25, 0.0f)};
  std::vector<char> has(25, 0);
  has[12] = 1;
  channels[0][12] = 7.0f;
  auto one = channels;
  detail::dilate(5, 5, 1, has, one);
  EXPECT_EQ(std::ranges::count(one[0], 7.0f), 9);
  detail::dilate(5, 5, 2, has, channels);
  EXPECT_EQ(std::ranges::count(channels[0], 7.0f), 25);
}

}  // namespace
}  // namespace penumbra
