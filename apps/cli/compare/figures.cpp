#include "apps/cli/compare/figures.h"

#include <algorithm>
#include <cmath>

namespace penumbra::apps {
namespace {

struct Resampling {
  double fraction;
  std::size_t at_least;
  int samples;
};
// Of the worst pixels. The oracle's rays take some ten times as long as Embree's.
constexpr Resampling kByRays{0.02, 1'000, 65'536}, kByOracle{0.0, 300, 32'768};
// Where p99 is so many times the references' noise, only so many of the worst pixels are traced again.
constexpr double kFarAboveNoise = 25.0;
constexpr std::size_t kFewWorst = 20;

std::vector<std::uint32_t> worst_pixels(const std::vector<float>& method, const Comparison& comparison,
                                        const Resampling& resampling) {
  std::vector<std::uint32_t> pixels = comparison.penumbra;
  const auto share =
      static_cast<std::size_t>(std::ceil(resampling.fraction * static_cast<double>(pixels.size())));
  const std::size_t count = std::min(pixels.size(), std::max(share, resampling.at_least));
  const auto error = [&](std::uint32_t i) { return std::abs(method[i] - comparison.reference[i]); };
  std::partial_sort(pixels.begin(), pixels.begin() + static_cast<std::ptrdiff_t>(count), pixels.end(),
                    [&](std::uint32_t a, std::uint32_t b) {
                      const float ea = error(a), eb = error(b);
                      return ea != eb ? ea > eb : a < b;
                    });
  pixels.resize(count);
  return pixels;
}

}  // namespace

Progress progress_on(ProgressLine& line, bool quiet) {
  return quiet ? Progress{} : line.callback();
}

void set_figures(Comparison& comparison, const std::vector<float>& method, const References& references,
                 bool quiet) {
  comparison.reference.resize(method.size());
  for (std::size_t i = 0; i < method.size(); ++i)
    comparison.reference[i] = 0.5f * references.first[i] + 0.5f * references.second[i];
  comparison.first = references.first;
  comparison.second = references.second;
  comparison.penumbra = true_penumbra(references.first, references.second, comparison.judged);
  ProgressLine progress("error figures");
  const auto figures = [&](const std::vector<std::uint32_t>& pixels) {
    return error_figures(method, references.first, references.second, pixels, progress_on(progress, quiet));
  };
  comparison.all = figures(comparison.judged);
  comparison.in_penumbra = figures(comparison.penumbra);
}

void resample_worst(Comparison& comparison, const std::vector<float>& method, References references,
                    const TraceAgain& trace, bool by_oracle, bool quiet) {
  Resampling resampling = by_oracle ? kByOracle : kByRays;
  if (comparison.in_penumbra.p99_absolute >=
      kFarAboveNoise * reference_noise(references.first, references.second, comparison.penumbra))
    resampling = {0.0, kFewWorst, resampling.samples};
  const std::vector<std::uint32_t> pixels = worst_pixels(method, comparison, resampling);
  const std::vector<float> values = trace(pixels, resampling.samples);
  for (std::size_t k = 0; k < pixels.size(); ++k)
    references.first[pixels[k]] = references.second[pixels[k]] = comparison.reference[pixels[k]] = values[k];
  const auto correct = [&](ErrorFigures& figures, const std::vector<std::uint32_t>& selected) {
    ProgressLine progress("error figures");
    const ErrorFigures again =
        error_figures(method, references.first, references.second, selected, progress_on(progress, quiet));
    figures.p99_absolute = again.p99_absolute;
    figures.max_absolute = again.max_absolute;
  };
  correct(comparison.all, comparison.judged);
  correct(comparison.in_penumbra, comparison.penumbra);
  comparison.resampled = pixels.size();
  comparison.resamples = resampling.samples;
}

}  // namespace penumbra::apps
