// study: the light as pixels see it, for the page's probe.
//
// Of every fourth pixel that the page shows, across and down, a square of 12 × 12 points of the light around
// its center: white where a ray from the pixel reaches it, else black. One lossless WebP a case, the squares
// side by side as their pixels are.
#pragma once

#include <optional>
#include <string>

#include "apps/cli/study/study_case.h"
#include "penumbra/render/receivers/surface_buffer.h"

namespace penumbra::apps {

/// Points of the light along a square's side.
inline constexpr int kDiskPoints = 12;
/// Pixels of the page between two squares.
inline constexpr int kDiskSpacing = 4;

/// Nothing where the light is a rectangle. Cost 144 rays for each square, and the casters' hierarchy.
std::optional<std::string> encode_disks(const StudyCase& seen, const SurfaceBuffer& surface, int threads);

}  // namespace penumbra::apps
