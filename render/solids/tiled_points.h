// Points in an order in which neighbors in the list are neighbors in space, for the one call for visibility.
#pragma once

#include <span>
#include <vector>

#include "penumbra/render/visibility.h"

namespace penumbra::detail {

/// O at each point. Each 64 that follow one another are one tile of receivers, so that nothing is sorted. Silhouettes are those of
/// all edges, none merged.
std::vector<float> seen_from(const Casters& casters, const LightShape& light, std::span<const Vec3> points);

}  // namespace penumbra::detail
