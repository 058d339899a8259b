// The margin over what pilots say: it is kept about as often as it claims, and is no larger than it has to
// be.
#include "render/plan/sample/ray_error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace penumbra {
namespace {

using detail::squared_error;
using detail::squared_error_kept;

constexpr double kVariance = 0.15, kBoundary = 0.5;

/// Receivers whose squared errors by n rays spread about the model's: by exp(spread·N), or none at all for
/// some.
struct Population {
  double spread, with_none;

  double mean(int samples) const {
    return (1.0 - with_none) * std::exp(0.5 * spread * spread) * squared_error(samples, kVariance, kBoundary);
  }
  RayPilot pilot(int samples, std::size_t receivers, std::mt19937_64& random) const {
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> uniform;
    RayPilot out{.samples = samples};
    for (std::size_t i = 0; i < receivers; ++i) {
      const double size = uniform(random) < with_none ? 0.0 : std::exp(spread * normal(random));
      const double error = normal(random);
      out.each.push_back({.error2 = size * squared_error(samples, kVariance, kBoundary) * error * error,
                          .group = static_cast<std::uint32_t>(i)});
    }
    return out;
  }
};

struct Kept {
  double share;
  double median;  ///< of the bound over the true mean
};

/// How often the true mean of `samples` rays is below what pilots of these numbers of rays say.
Kept kept(const Population& population, std::vector<int> pilots, std::size_t receivers, int samples) {
  constexpr int kTrials = 2'000;
  std::mt19937_64 random(7);
  std::vector<double> ratios;
  int count = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    SampledFacts facts{.variance = kVariance, .boundary = kBoundary};
    for (const int n : pilots) facts.pilots.push_back(population.pilot(n, receivers, random));
    ratios.push_back(squared_error_kept(facts, samples, 0) / population.mean(samples));
    count += ratios.back() >= 1.0 ? 1 : 0;
  }
  std::ranges::nth_element(ratios, ratios.begin() + kTrials / 2);
  return {static_cast<double>(count) / kTrials, ratios[kTrials / 2]};
}

TEST(RayErrorProperty, TheBoundIsKeptNineteenTimesOfTwentyAbout) {
  for (const Population population : {Population{0.0, 0.0}, Population{0.7, 0.0}, Population{0.5, 0.5}})
    for (const std::size_t receivers : {16, 48, 128})
      for (const std::vector<int>& pilots : {std::vector<int>{64}, std::vector<int>{30, 64}}) {
        const Kept now = kept(population, pilots, receivers, 64);
        // Samples that have missed the large errors do not know of them: a little less than 0.95.
        EXPECT_GE(now.share, 0.90) << population.spread << ", " << receivers << ", " << pilots.size();
        EXPECT_LE(now.share, receivers < 20 ? 1.0 : 0.995)
            << population.spread << ", " << receivers << ", " << pilots.size();
      }
}

TEST(RayErrorProperty, MoreReceiversNeedLessMargin) {
  const Population population{0.5, 0.2};
  double before = 100.0;
  for (const std::size_t receivers : {8, 32, 128, 512}) {
    const double median = kept(population, {64}, receivers, 64).median;
    EXPECT_LT(median, before) << receivers;
    EXPECT_GT(median, 1.0);
    before = median;
  }
  EXPECT_LT(before, 1.25);
}

TEST(RayErrorProperty, APilotNearThePlannedNumberNeedsLessMargin) {
  const Population population{0.5, 0.0};
  const double far = kept(population, {30}, 128, 1024).median;
  EXPECT_LT(kept(population, {30, 1024}, 128, 1024).median, 0.8 * far);
  // Without that pilot the exponent may be wrong by a quarter.
  EXPECT_GT(far, 1.5);
}

TEST(RayErrorProperty, WithoutPenumbraTheUsualOneIsTakenWithMuchMargin) {
  const SampledFacts facts{
      .variance = detail::kUsualVariance, .boundary = detail::kUsualBoundary, .pilots = {{.samples = 30}}};
  const double usual = squared_error(30, detail::kUsualVariance, detail::kUsualBoundary);
  EXPECT_GT(squared_error_kept(facts, 30, 0), 3.0 * usual);
  EXPECT_LT(squared_error_kept(facts, 30, 0), 20.0 * usual);
}

// The number of edges is binomial where each is looked at with the same probability.
TEST(RayErrorProperty, TheChanceOfMoreEdgesIsThatOfASample) {
  EXPECT_EQ(detail::chance_of_more(12.0, 11, 1.0), 1.0);
  EXPECT_EQ(detail::chance_of_more(11.0, 11, 1.0), 0.0);
  std::mt19937_64 random(3);
  std::uniform_int_distribution<int> number(0, 400);
  constexpr double kEach = 10.0, kMost = 100.0;
  std::vector<int> seen_at(60), more_at(60);
  for (int trial = 0; trial < 200'000; ++trial) {
    const int edges = number(random);
    const int seen = std::binomial_distribution<int>(edges, 1.0 / kEach)(random);
    if (seen >= 60) continue;
    ++seen_at[static_cast<std::size_t>(seen)];
    more_at[static_cast<std::size_t>(seen)] += edges > kMost ? 1 : 0;
  }
  for (std::size_t seen = 0; seen <= 25; ++seen) {
    const double share = more_at[seen] / static_cast<double>(seen_at[seen]);
    EXPECT_NEAR(detail::chance_of_more(kEach * static_cast<double>(seen), kMost, kEach), share, 0.12) << seen;
  }
}

TEST(RayErrorProperty, ReceiversWithFewEdgesHaveNoErrorOfRays) {
  SampledFacts facts{.variance = kVariance, .boundary = kBoundary};
  facts.pilots.push_back({.samples = 64});
  const double each = squared_error(64, kVariance, kBoundary);
  for (int i = 0; i < 100; ++i)
    facts.pilots[0].each.push_back(
        {.error2 = each, .edges = i < 75 ? 5.0 : 50.0, .group = static_cast<std::uint32_t>(i)});
  const double all = squared_error_kept(facts, 64, 0), quarter = squared_error_kept(facts, 64, 10),
               none = squared_error_kept(facts, 64, 100);
  EXPECT_NEAR(quarter / all, 0.25, 0.12);
  EXPECT_GT(none, 0.0);
  EXPECT_LT(none, 0.25 * all);
}

}  // namespace
}  // namespace penumbra
