// D-buffer step 3: which perspectives from the light's center a D-buffer needs.
//
// In: where the casters and their penumbrae are seen, in (x/z, y/z) of the light's frame. Out: targets. A
// light close to its casters needs several.
#pragma once

#include <array>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <vector>

#include "penumbra/mesh/types.h"

namespace penumbra::detail {

/// Accuracy: nothing nearer to the light's plane than this is drawn, in the light's frame, where the scene
/// has about unit size. Casters are cut there. Larger: more of a caster beside the light is lost
/// (DBuffer.CasterAcrossTheLightsPlane).
inline constexpr double kNearDepth = 0x1p-13;

struct Target {
  /// Light's frame → (right, up, forward).
  glm::dmat3 axes;
  /// Left, right, bottom, top at forward distance 1.
  std::array<double, 4> window;
};

/// Accuracy: the widest |x/z| or |y/z| that one perspective may have. Beyond it texels near the axis get too
/// large, and the sides of a hemicube keep them even
/// (DBuffer.WideScenesUseAHemicubeThatAgreesWithOnePerspective).
inline constexpr double kWidestWindow = 2.5;

/// Targets of size × size texels that see the rectangle `low` to `high` of (x/z, y/z): one perspective fitted
/// to it, with a margin of two texels, where that is narrow enough; else the front side of a hemicube and
/// those others that see some of the rectangle. None where low > high: nothing casts.
std::vector<Target> choose_targets(const glm::dvec2& low, const glm::dvec2& high, int size);

}  // namespace penumbra::detail
