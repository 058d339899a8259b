// bake: values of faces or vertices as files.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "penumbra/mesh/triangle_mesh.h"

namespace penumbra::apps {

/// One list a channel. PLY has the mesh and a float property for each channel, called as the channel with _
/// for a dot; NPY is float32 of shape (n), or (n, channels) where there are several. The extension says
/// which. Whole or not at all. Throws SystemError.
void write_values(const std::filesystem::path& path, const TriangleMesh& mesh, bool of_vertices,
                  const std::vector<std::string>& names, const std::vector<std::vector<float>>& values);

}  // namespace penumbra::apps
