// What solids and fields ask of casters: their meshes, and visibility at points of which neighbors in the
// list are neighbors in space.
#pragma once

#include <span>
#include <vector>

#include "penumbra/render/visibility.h"

namespace penumbra::detail {

/// Of the objects that cast and are not empty.
std::vector<TriangleMesh> casting_meshes(const Casters& casters);

/// O at each point. Each 64 that follow one another are one tile of receivers, so that nothing is sorted.
/// Silhouettes are those of all edges, none merged. `progress` is that of this call alone. Throws Cancelled.
std::vector<float> seen_from(const Casters& casters, const LightShape& light, std::span<const Vec3> points,
                             const Progress& progress = {});

}  // namespace penumbra::detail
