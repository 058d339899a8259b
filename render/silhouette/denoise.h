// A filter for few rays a pixel, as renderers use it: joint-bilateral, guided by position and normal, à
// trous.
//
//   H. Dammertz, D. Sewtz, J. Hanika, H. Lensch, "Edge-Avoiding À-Trous Wavelet Transform for Fast Global
//   Illumination Filtering", 2010: five taps a row, twice as far apart at each level. C. Schied and others,
//   "Spatiotemporal Variance-Guided Filtering", 2017: neighbors count for less where they differ by more than
//   noise explains, and by the cosine between normals to the power of 128. Of that only the spatial part is
//   here. The variance is not measured but known: of n strata about √n are crossed by a silhouette, so that V
//   = p has a variance of about p (1 - p) n^-3/2.
//
// It trades noise for blur: narrow penumbras and small features of a shadow are lost.
#pragma once

#include <tbb/task_arena.h>

#include <cstdint>
#include <span>
#include <vector>

#include "penumbra/mesh/progress.h"
#include "penumbra/render/receivers/receivers.h"

namespace penumbra {

struct DenoiseOptions {
  /// Rays a pixel that `noisy` has.
  int samples = 16;
  /// Taps lie up to 2^levels pixels away.
  int levels = 4;
  /// Neighbors that differ by so many standard deviations count 1/e.
  double deviations = 3.0;
  /// A neighbor in a direction whose sine with the tangent plane is this counts 1/e.
  double out_of_plane = 0.1;
};

/// V of every pixel. Those of `open` are filtered, all others are exact and stay as they are. Throws
/// UsageError where the receivers are not pixels with normals and objects, Cancelled. Cost O(levels ·
/// |open|).
std::vector<float> denoise(const Receivers& pixels, std::span<const float> noisy,
                           std::span<const std::uint32_t> open, const DenoiseOptions& options,
                           tbb::task_arena& threads, const Progress& progress = {});

}  // namespace penumbra
