// ꟻLIP against values of its definition that were computed in another way: in Python, with the constants and
// the kernels in two dimensions of the authors' program (flip_api.py of version 1.2).
#include "render/image/flip.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numeric>

namespace penumbra {
namespace {

constexpr int kWidth = 48, kHeight = 32;
// Their inverse matrix has ten digits.
constexpr double kTolerance = 2e-6;

using Picture = std::vector<float>;

Picture picture(const std::function<double(int x, int y, int channel)>& value) {
  Picture out;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      for (int c = 0; c < 3; ++c) out.push_back(static_cast<float>(value(x, y, c)));
  return out;
}

double wave(int x, int y, int channel) {
  if (channel == 0) return 0.5 + 0.5 * std::sin(0.3 * x + 0.1 * y);
  if (channel == 1) return 0.5 + 0.5 * std::sin(0.21 * y);
  return 0.5 + 0.5 * std::cos(0.17 * x - 0.2 * y);
}
double other_wave(int x, int y, int channel) {
  return std::min(1.0, 0.8 * wave(x, y, channel) + 0.1 * ((x / 6 + y / 5) % 2));
}
double step(int x, int, int) {
  return x > 20 ? 1.0 : 0.0;
}

struct Values {
  double mean, at_7_5, at_30_20, at_47_31;
};

void expect_values(const Picture& a, const Picture& b, const Values& values, FlipOptions options = {}) {
  const std::vector<float> map = flip_map(kWidth, kHeight, a, b, options);
  const auto at = [&](int x, int y) {
    return static_cast<double>(map[static_cast<std::size_t>(y * kWidth + x)]);
  };
  EXPECT_NEAR(std::accumulate(map.begin(), map.end(), 0.0) / (kWidth * kHeight), values.mean, kTolerance);
  EXPECT_NEAR(at(7, 5), values.at_7_5, kTolerance);
  EXPECT_NEAR(at(30, 20), values.at_30_20, kTolerance);
  EXPECT_NEAR(at(47, 31), values.at_47_31, kTolerance);
}

TEST(Flip, IsThatOfTheDefinition) {
  const Picture a = picture(wave), b = picture(other_wave);
  expect_values(a, b, {0.3564033598, 0.3160147404, 0.3543110021, 0.2899585485});
  expect_values(b, a, {0.3564033598, 0.3160147404, 0.3543110021, 0.2899585485});
}

TEST(Flip, FollowsTheDistanceOfTheEye) {
  expect_values(picture(wave), picture(other_wave), {0.3806090682, 0.3197796962, 0.4551680023, 0.2986117634},
                {.pixels_per_degree = 20.0});
}

TEST(Flip, EdgesEnlargeIt) {
  const Picture soft = picture([](int x, int y, int c) { return 0.25 + 0.5 * step(x, y, c); });
  expect_values(picture(step), soft, {0.6029011541, 0.9509146118, 0.3005245394, 0.3005245394});
}

TEST(Flip, HasKnownEnds) {
  const auto flat = [](float r, float g, float b) { return Picture{r, g, b}; };
  const auto one = [](const Picture& a, const Picture& b) { return flip_map(1, 1, a, b).front(); };
  EXPECT_EQ(one(flat(0.3f, 0.4f, 0.5f), flat(0.3f, 0.4f, 0.5f)), 0.0f);
  EXPECT_NEAR(one(flat(0, 1, 0), flat(0, 0, 1)), 1.0f, 1e-6f);  // the largest of all, by definition
  EXPECT_NEAR(one(flat(0, 0, 0), flat(1, 1, 1)), 0.96737976f, 1e-6f);
  EXPECT_EQ(one(flat(0, 0, 0), flat(7, 7, 7)), one(flat(0, 0, 0), flat(1, 1, 1)));
}

}  // namespace
}  // namespace penumbra
