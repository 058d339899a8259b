// D-buffer step 3: which perspectives from the light's center a D-buffer needs.
//
// In: where the casters and their penumbras are seen, in (u, v) of light space. Out: targets. A light close
// to its casters needs several; a distant one never does.
#pragma once

#include <array>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <vector>

#include "penumbra/mesh/types.h"
#include "render/d_buffer/view/uv_bounds.h"

namespace penumbra::detail {

struct Target {
  /// (u, v, 1) · weight → (right, up, forward).
  glm::dmat3 axes;
  /// Left, right, bottom, top at forward distance 1.
  std::array<double, 4> window;
};

/// Accuracy: the widest |u| or |v|, from the light's own axis in units of the depth, that one perspective
/// about that axis may have. Beyond it texels near the axis get too large, and the sides of a hemicube keep
/// them even (DBuffer.WideScenesUseAHemicubeThatAgreesWithOnePerspective).
inline constexpr double kWidestWindow = 2.5;

/// Whether one perspective is too wide for the window, which is relative to the light's own axis. A window
/// far from the axis is stretched as a whole, which does no harm.
bool needs_hemicube(const UvBounds& window);

/// The perspective of size × size texels fitted to the window, with a margin of two texels.
Target one_target(const UvBounds& window, int size);

/// The front side of a hemicube and those others that see some of the window, which is relative to the
/// light's own axis.
std::vector<Target> hemicube(const UvBounds& window);

}  // namespace penumbra::detail
