#include "penumbra/render/image/error_figures.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace penumbra {
namespace {

constexpr int kResamples = 200;
constexpr std::uint64_t kBootstrapSeed = 0x5eed;

// SplitMix64: S. Vigna's public-domain finaliser of Steele, Lea and Flood, "Fast splittable pseudorandom
// number generators" (2014). The same numbers everywhere, which std::uniform_int_distribution does not
// promise.
class SplitMix64 {
 public:
  explicit SplitMix64(std::uint64_t seed) : state_(seed) {}
  /// Uniform in [0, n) for n < 2³², by the high half of a product.
  std::size_t below(std::size_t n) {
    state_ += 0x9e3779b97f4a7c15;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    z ^= z >> 31;
    return static_cast<std::size_t>(((z >> 32) * n) >> 32);
  }

 private:
  std::uint64_t state_;
};

double root(double mse) {
  return std::sqrt(std::max(0.0, mse));
}

// The smallest value that at least `fraction` of the values do not exceed. Reorders its argument.
double quantile(std::vector<double>& values, double fraction) {
  const auto rank = static_cast<std::size_t>(std::ceil(fraction * static_cast<double>(values.size())));
  const auto nth = values.begin() + static_cast<std::ptrdiff_t>(std::max<std::size_t>(rank, 1) - 1);
  std::nth_element(values.begin(), nth, values.end());
  return *nth;
}

// 95% interval of the RMSE: means over pixels drawn with replacement. Errors of neighboring pixels are not
// independent, so this states how well the *pixels at hand* fix the figure, not how other views would
// scatter.
void add_interval(ErrorFigures& figures, const std::vector<double>& products, const Progress& progress) {
  SplitMix64 random(kBootstrapSeed);
  std::vector<double> roots;
  for (int k = 0; k < kResamples; ++k) {
    double sum = 0.0;
    for (std::size_t i = 0; i < products.size(); ++i) sum += products[random.below(products.size())];
    roots.push_back(root(sum / static_cast<double>(products.size())));
    report(progress, (k + 1.0) / kResamples);
  }
  figures.rmse_low = quantile(roots, 0.025);
  figures.rmse_high = quantile(roots, 0.975);
}

}  // namespace

ErrorFigures error_figures(std::span<const float> method, std::span<const float> reference1,
                           std::span<const float> reference2, std::span<const std::uint32_t> selected,
                           const Progress& progress) {
  assert(method.size() == reference1.size() && method.size() == reference2.size());
  ErrorFigures figures;
  figures.pixels = selected.size();
  if (selected.empty()) return figures;

  std::vector<double> products, absolute;
  products.reserve(selected.size());
  absolute.reserve(selected.size());
  double sum_products = 0.0, sum = 0.0, sum_absolute = 0.0;
  for (const std::uint32_t i : selected) {
    const double d1 = double{method[i]} - double{reference1[i]};
    const double d2 = double{method[i]} - double{reference2[i]};
    const double d = 0.5 * (d1 + d2);
    products.push_back(d1 * d2);
    absolute.push_back(std::abs(d));
    sum_products += d1 * d2;
    sum += d;
    sum_absolute += std::abs(d);
  }
  const auto count = static_cast<double>(selected.size());
  figures.mse = sum_products / count;
  figures.rmse = root(figures.mse);
  figures.mean = sum / count;
  figures.mean_absolute = sum_absolute / count;
  figures.max_absolute = *std::max_element(absolute.begin(), absolute.end());
  figures.p99_absolute = quantile(absolute, 0.99);
  figures.median_absolute = quantile(absolute, 0.5);
  add_interval(figures, products, progress);
  return figures;
}

double reference_noise(std::span<const float> reference1, std::span<const float> reference2,
                       std::span<const std::uint32_t> selected) {
  double sum = 0.0;
  for (const std::uint32_t i : selected) {
    const double half = 0.5 * (reference1[i] - double{reference2[i]});
    sum += half * half;
  }
  return std::sqrt(sum / std::max(1.0, static_cast<double>(selected.size())));
}

std::vector<std::uint32_t> true_penumbra(std::span<const float> reference1, std::span<const float> reference2,
                                         std::span<const std::uint32_t> candidates) {
  std::vector<std::uint32_t> pixels;
  for (const std::uint32_t i : candidates) {
    const double mean = 0.5 * (double{reference1[i]} + double{reference2[i]});
    if (mean > 0.0 && mean < 1.0) pixels.push_back(i);
  }
  return pixels;
}

}  // namespace penumbra
