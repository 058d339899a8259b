// Bake: faces that lie on each other in the texture, where a texel would have two values.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "penumbra/render/bake/texture_atlas.h"

namespace penumbra::detail {

/// The area that both triangles cover, however they turn.
double common_area(const FaceUv& a, const FaceUv& b);

/// Pairs of numbers of triangles with a common area of more than `least`, the lower number first, in order of
/// the pairs; at most `most` of them, which need not be the first. Expected cost O(n log n + pairs of
/// bounding boxes that overlap in x).
std::vector<std::pair<std::uint32_t, std::uint32_t>> find_overlaps(std::span<const FaceUv> triangles,
                                                                   double least, std::size_t most);

}  // namespace penumbra::detail
