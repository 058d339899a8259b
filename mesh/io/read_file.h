// A whole file as bytes.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

namespace penumbra::detail {

/// Throws MeshError where it is missing, no regular file, empty or cannot be read.
std::vector<std::byte> read_bytes(const std::filesystem::path& path);

}  // namespace penumbra::detail
