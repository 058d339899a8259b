// Which perspectives around the light a D-buffer needs.
#pragma once

#include <array>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <vector>

#include "penumbra/mesh/types.h"

namespace penumbra::detail {

/// Nothing nearer to the light's plane than this (of the scene's size) is drawn: casters are cut there.
inline constexpr double kNearDepth = 0x1p-13;

struct Target {
  glm::dmat3 axes;               ///< light's frame → (right, up, forward)
  std::array<double, 4> window;  ///< left, right, bottom, top at forward distance 1
};

/// Widest |x/z| or |y/z| that one perspective may have; beyond it the sides of a hemicube keep the texels
/// even.
inline constexpr double kWidestWindow = 2.5;

/// One perspective of size × size texels fitted to `low`..`high` in (x/z, y/z), with a margin of two texels,
/// where that is narrow enough, else those sides of a hemicube that see some of it (the front one always).
/// None where low > high: nothing casts.
std::vector<Target> choose_targets(const glm::dvec2& low, const glm::dvec2& high, int size);

}  // namespace penumbra::detail
