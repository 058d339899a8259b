// Meshes of a scene: read once each, placed in the world, with one line about what they needed.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "penumbra/mesh/io/polygon_soup.h"
#include "penumbra/mesh/triangle_mesh.h"
#include "render/scene/transform.h"

namespace penumbra::detail {

class MeshCache {
 public:
  struct Entry {
    std::vector<Vec3> positions;
    Triangulation triangulation;
  };
  /// Reads the file the first time it is asked for. Throws MeshError.
  const Entry& get(const std::filesystem::path& path);

 private:
  std::map<std::filesystem::path, Entry> entries_;
};

/// The mesh in world space: transformed in double, winding turned where the transform mirrors. Throws
/// MeshError where nothing is left of it.
TriangleMesh place_mesh(const MeshCache::Entry& entry, const Transform& transform);

/// What reading and building did to a mesh, in one line; empty where it was taken as it is.
std::string summary_of(const Triangulation& triangulation, const BuildReport& report);

}  // namespace penumbra::detail
