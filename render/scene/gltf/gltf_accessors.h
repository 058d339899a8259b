// Accessors of glTF: arrays in buffers, of which nothing is trusted.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "penumbra/mesh/types.h"
#include "render/scene/gltf/gltf_file.h"

namespace penumbra::detail {

/// `components` numbers an element, in double, normalized integers as fractions, sparse values put in. Throws
/// SceneError where the accessor does not exist, has another type, or leaves its buffer.
std::vector<double> read_numbers(const GltfFile& file, int accessor, int components, const std::string& what);

std::vector<Vec3> read_vectors(const GltfFile& file, int accessor, const std::string& what);

/// Whole numbers of 1, 2 or 4 bytes, each below `limit`.
std::vector<std::uint32_t> read_indices(const GltfFile& file, int accessor, std::size_t limit,
                                        const std::string& what);

}  // namespace penumbra::detail
