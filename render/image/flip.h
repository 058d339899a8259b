// ꟻLIP: how large the difference of two pictures looks to a person who flips between them.
//
// Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström and Fairchild, "FLIP: A Difference Evaluator for
// Alternating Images",
// 2020. Colors are blurred as the eye blurs them at a viewing distance (contrast sensitivity of an opponent
//       space), their
// differences measured in a space in which equal steps look equal (HyAB distance of Hunt-adjusted CIELab),
// and enlarged where edges or points differ (first and second derivatives of a Gaussian).
#pragma once

#include <span>
#include <vector>

namespace penumbra {

struct FlipOptions {
  /// Pixels a degree of the visual field: 0.7 m before a screen 0.7 m wide with 3,840 pixels, as in the
  /// paper.
  double pixels_per_degree = 67.0206;
};

/// One value a pixel, 0 (alike) to 1. `reference` and `test` are linear RGB, width·height·3; what is outside
/// [0, 1] is cut off. Symmetric. Cost O(pixels · pixels_per_degree), on all threads.
std::vector<float> flip_map(int width, int height, std::span<const float> reference,
                            std::span<const float> test, const FlipOptions& options = {});

}  // namespace penumbra
