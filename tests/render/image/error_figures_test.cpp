#include "penumbra/render/image/error_figures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace penumbra {
namespace {

using Values = std::vector<float>;
using Pixels = std::vector<std::uint32_t>;

struct Sample {
  Values method, first, second;
  Pixels all;
};

// A "true" visibility, a method with the given bias and error, and two references with independent noise.
Sample noisy_sample(std::size_t count, double bias, double error, double noise, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> truth(0.2, 0.8);
  std::normal_distribution<double> normal;
  Sample sample;
  for (std::size_t i = 0; i < count; ++i) {
    const double v = truth(random);
    sample.method.push_back(static_cast<float>(v + bias + error * normal(random)));
    sample.first.push_back(static_cast<float>(v + noise * normal(random)));
    sample.second.push_back(static_cast<float>(v + noise * normal(random)));
    sample.all.push_back(static_cast<std::uint32_t>(i));
  }
  return sample;
}

ErrorFigures figures_of(const Sample& s) {
  return error_figures(s.method, s.first, s.second, s.all);
}

TEST(ErrorFigures, NothingSelectedIsAllZero) {
  const ErrorFigures figures = error_figures(Values{1}, Values{0}, Values{0}, {});
  EXPECT_EQ(figures.pixels, 0u);
  EXPECT_EQ(figures.rmse, 0.0);
  EXPECT_EQ(figures.max_absolute, 0.0);
}

TEST(ErrorFigures, ByHand) {
  // Differences from the mean reference: +0.5, -0.25, 0, 0 (and one pixel that is not selected).
  const Values method{1.0f, 0.25f, 0.5f, 0.5f, 9.0f}, reference{0.5f, 0.5f, 0.5f, 0.5f, 0.0f};
  const ErrorFigures figures = error_figures(method, reference, reference, Pixels{0, 1, 2, 3});
  EXPECT_EQ(figures.pixels, 4u);
  EXPECT_DOUBLE_EQ(figures.mse, (0.25 + 0.0625) / 4);
  EXPECT_DOUBLE_EQ(figures.rmse, std::sqrt(figures.mse));
  EXPECT_DOUBLE_EQ(figures.mean, 0.0625);
  EXPECT_DOUBLE_EQ(figures.mean_absolute, 0.1875);
  EXPECT_DOUBLE_EQ(figures.median_absolute, 0.0);
  EXPECT_DOUBLE_EQ(figures.p99_absolute, 0.5);
  EXPECT_DOUBLE_EQ(figures.max_absolute, 0.5);
}

TEST(ErrorFigures, AgreesWithBruteForce) {
  const Sample s = noisy_sample(1'234, 0.01, 0.05, 0.02, 3);
  const ErrorFigures figures = figures_of(s);
  std::vector<double> absolute;
  double mse = 0, mean = 0;
  for (std::size_t i = 0; i < s.method.size(); ++i) {
    mse += (double(s.method[i]) - s.first[i]) * (double(s.method[i]) - s.second[i]) / 1'234;
    const double d = s.method[i] - (double(s.first[i]) + s.second[i]) / 2;
    mean += d / 1'234;
    absolute.push_back(std::abs(d));
  }
  std::sort(absolute.begin(), absolute.end());
  EXPECT_NEAR(figures.mse, mse, 1e-12);
  EXPECT_NEAR(figures.mean, mean, 1e-12);
  EXPECT_NEAR(figures.mean_absolute, std::accumulate(absolute.begin(), absolute.end(), 0.0) / 1'234, 1e-12);
  EXPECT_NEAR(figures.median_absolute, absolute[616], 1e-9);  // 617 of 1,234 do not exceed it
  EXPECT_NEAR(figures.p99_absolute, absolute[1'221], 1e-9);   // 1,222 of 1,234
  EXPECT_NEAR(figures.max_absolute, absolute.back(), 1e-9);
}

TEST(ErrorFigures, NoiseOfTheReferencesIsTakenOut) {
  // The method is perfect, the references are not: the plain mean square against one of them would be noise².
  const double noise = 0.02;
  double sum = 0.0;
  for (unsigned seed = 1; seed <= 20; ++seed) sum += figures_of(noisy_sample(5'000, 0, 0, noise, seed)).mse;
  EXPECT_LT(std::abs(sum / 20),
            0.02 * noise * noise);  // four standard errors of the mean over 100,000 pixels
}

TEST(ErrorFigures, RmseIsThatOfTheMethodUnderNoise) {
  const ErrorFigures figures = figures_of(noisy_sample(200'000, 0.01, 0.03, 0.05, 5));
  EXPECT_NEAR(figures.rmse, std::hypot(0.01, 0.03), 5e-4);
  EXPECT_NEAR(figures.mean, 0.01, 5e-4);
}

TEST(ErrorFigures, IntervalHoldsTheEstimateAndTheTruth) {
  int held = 0;
  for (unsigned seed = 1; seed <= 40; ++seed) {
    const ErrorFigures figures = figures_of(noisy_sample(2'000, 0, 0.03, 0.01, seed));
    EXPECT_LE(figures.rmse_low, figures.rmse);
    EXPECT_GE(figures.rmse_high, figures.rmse);
    held += figures.rmse_low <= 0.03 && 0.03 <= figures.rmse_high;
  }
  EXPECT_GE(held, 34);  // 38 expected of 40; below 34 has a probability of about 1%
  EXPECT_LT(held, 41);
}

TEST(ErrorFigures, IntervalNarrowsWithPixels) {
  const ErrorFigures few = figures_of(noisy_sample(500, 0, 0.03, 0.01, 2));
  const ErrorFigures many = figures_of(noisy_sample(50'000, 0, 0.03, 0.01, 2));
  EXPECT_LT(many.rmse_high - many.rmse_low, 0.2 * (few.rmse_high - few.rmse_low));
}

TEST(ErrorFigures, Deterministic) {
  const Sample s = noisy_sample(1'000, 0.01, 0.03, 0.01, 9);
  EXPECT_EQ(figures_of(s), figures_of(s));
}

TEST(ErrorFigures, TruePenumbraIsStrictlyBetween) {
  const Values first{0.0f, 1.0f, 0.0f, 1.0f, 0.5f, 0.5f}, second{0.0f, 1.0f, 1e-4f, 0.9999f, 0.5f, 0.5f};
  EXPECT_EQ(true_penumbra(first, second, Pixels{0, 1, 2, 3, 4}), (Pixels{2, 3, 4}));
}

}  // namespace
}  // namespace penumbra
