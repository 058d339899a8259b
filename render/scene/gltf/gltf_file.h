// A glTF file, read and looked through: what it needs that is not understood is refused by name.
//
// In: the bytes of a .gltf or .glb. Out: tinygltf's model with its buffers. Images are left out before it is
// parsed, and values nest 64 deep at most, since parsers recurse.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "render/scene/gltf/tiny_gltf.h"

namespace penumbra::detail {

struct GltfFile {
  /// For messages.
  std::string name;
  tinygltf::Model model;
  /// Buffers that were read from files.
  std::vector<std::filesystem::path> files;
  bool has_images = false;

  /// Throws SceneError: "name: where: what; advice".
  [[noreturn]] void fail(const std::string& where, const std::string& what, const std::string& advice) const;
};

/// Whether the bytes begin as a .glb does.
bool begins_like_glb(std::span<const std::byte> bytes);

/// `folder` is where paths of buffers start. Throws SceneError for what is no glTF 2.0, for files that cannot
/// be read, and for required extensions that are not known: compression by Draco and by meshopt among them.
GltfFile read_gltf_file(std::span<const std::byte> bytes, const std::filesystem::path& folder,
                        const std::string& name);

}  // namespace penumbra::detail
