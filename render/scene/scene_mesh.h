// Meshes of a scene: read once each, placed in the world, with one line about what they needed.
#pragma once

#include <filesystem>
#include <glm/vec2.hpp>
#include <map>
#include <string>

#include "penumbra/mesh/io/polygon_soup.h"
#include "penumbra/mesh/triangle_mesh.h"
#include "penumbra/render/scene/scene.h"
#include "render/scene/transform.h"

namespace penumbra::detail {

class MeshCache {
 public:
  struct Entry {
    std::vector<Vec3> positions;
    Triangulation triangulation;
    /// As in PolygonSoup.
    std::vector<Material> materials;
    std::vector<std::uint32_t> polygon_material;
    std::vector<Vec3> normals;
    std::vector<std::uint32_t> corner_normals;
    /// Texture coordinates of the corners of triangles that were read, three a triangle, NaN where one has
    /// none. Only glTF files have them.
    std::vector<glm::dvec2> corner_uv{};
    std::vector<std::string> ignored;
    /// What was read: the mesh, unless it came from memory, and its files of materials.
    std::vector<std::filesystem::path> files;
  };
  /// Of a file that was read already.
  static Entry entry_of(PolygonSoup soup);
  /// Reads the file the first time it is asked for. Throws MeshError.
  const Entry& get(const std::filesystem::path& path);
  /// Of all entries.
  std::vector<std::filesystem::path> files() const;

 private:
  std::map<std::filesystem::path, Entry> entries_;
};

/// The mesh in world space: transformed in double, winding turned where the transform mirrors. Throws
/// MeshError where nothing is left of it.
TriangleMesh place_mesh(const MeshCache::Entry& entry, const Transform& transform);

/// Gives the object the colors of its materials: one albedo, or one for each face where they differ. Faces
/// whose material has no color, or that have none, keep the object's albedo. The object's mesh is one of the
/// entry's.
void take_material_colors(const MeshCache::Entry& entry, SceneObject& object);

/// Gives the object the normals of its file's corners, in the world. Corners that have none get that of the
/// face. The object's mesh is the entry's under this transform.
void take_normals(const MeshCache::Entry& entry, const Transform& transform, SceneObject& object);

/// Gives the object the texture coordinates of its file's corners. The object's mesh is the entry's under
/// this transform.
void take_uv(const MeshCache::Entry& entry, const Transform& transform, SceneObject& object);

/// What reading and building did to a mesh, and what of its file is not used, in one line; empty where it was
/// taken as it is.
std::string summary_of(const MeshCache::Entry& entry, const BuildReport& report);

}  // namespace penumbra::detail
