// Bake: values of texels along the borders of charts, so that bilinear lookups are right there.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "penumbra/render/bake/lightmap.h"

namespace penumbra::detail {

/// The four texels of a bilinear lookup, as indices into a channel, and their weights.
struct BilinearTexels {
  std::array<std::size_t, 4> index;
  std::array<double, 4> weight;
};
BilinearTexels bilinear_texels(int width, int height, const glm::dvec2& at);

/// What a lookup at a point should give.
struct BorderSample {
  glm::dvec2 at;
  double weight;
};

/// Changes the texels of `channel` whose numbers are in `unknown` so that Σ weight · (lookup - value)² over
/// the samples is least. What samples leave open stays near the values that are there. Sparse least squares
/// by conjugate gradients; deterministic. Cost O(samples) a step, some tens of steps.
void fit_borders(int width, int height, const std::vector<BorderSample>& samples,
                 const std::vector<float>& values, const std::vector<std::uint32_t>& unknown,
                 std::vector<float>& channel);

/// Gives texels without a value the mean of their neighbors with one, `rounds` times.
void dilate(int width, int height, int rounds, std::vector<char> has_value,
            std::vector<std::vector<float>>& channels);

}  // namespace penumbra::detail
