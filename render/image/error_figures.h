// How wrong an image is: the figures of `penumbra compare`.
//
// Errors are of visibility. The reference is noisy itself: with two independently scrambled references r1 and
// r2, the mean of (m - r1)(m - r2) is an unbiased estimate of the mean squared error, since the two noises
// are independent. True penumbra is 0 < (r1 + r2)/2 < 1.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "penumbra/mesh/progress.h"

namespace penumbra {

struct ErrorFigures {
  std::size_t pixels = 0;
  double rmse = 0.0;                       ///< sqrt(max(0, mse))
  double mse = 0.0;                        ///< noise taken out; may be slightly negative
  double rmse_low = 0.0, rmse_high = 0.0;  ///< 95% bootstrap interval
  double mean = 0.0;                       ///< of m - (r1 + r2)/2: positive is too bright
  double mean_absolute = 0.0;
  double median_absolute = 0.0, p99_absolute = 0.0, max_absolute = 0.0;  ///< against (r1 + r2)/2
  friend bool operator==(const ErrorFigures&, const ErrorFigures&) = default;
};

/// `selected` lists the pixels to judge. Deterministic (the bootstrap's seed is fixed). Cost O(200 n). Throws
/// Cancelled.
ErrorFigures error_figures(std::span<const float> method, std::span<const float> reference1,
                           std::span<const float> reference2, std::span<const std::uint32_t> selected,
                           const Progress& progress = {});
/// The RMS noise of (r1 + r2)/2 over these pixels: half of that of r1 - r2. 0 for none.
double reference_noise(std::span<const float> reference1, std::span<const float> reference2,
                       std::span<const std::uint32_t> selected);
/// Pixels of `candidates` in true penumbra.
std::vector<std::uint32_t> true_penumbra(std::span<const float> reference1, std::span<const float> reference2,
                                         std::span<const std::uint32_t> candidates);

}  // namespace penumbra
