// Reading and writing mesh files: PLY (ASCII, binary of either byte order), OBJ, OFF (text) and STL (ASCII,
// binary).
//
// In: a path or bytes. Out: positions in double and polygons as lists of indices, exactly as the file has
// them; `triangulate` makes triangles of them. Nothing in a file is trusted: counts are checked against its
// size before memory is reserved, every index is checked, every coordinate that a face uses must be finite;
// other vertices that are not are put at 0. Colors of vertices and faces, texture coordinates and all that is
// not vertices, faces, normals and materials are skipped, and named in `ignored`.
//
// The readers are our own: OpenMesh's read single precision only and trust the counts that they find, and a
// bad file must give a clear message.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "penumbra/mesh/triangle_mesh.h"
#include "penumbra/mesh/types.h"

namespace penumbra {

struct Material {
  std::string name;
  /// Diffuse reflectance, linear, 0 to 1 each.
  std::optional<Vec3> color{};
};

/// Polygons over shared vertices. Nothing is said of how they are connected.
struct PolygonSoup {
  std::vector<Vec3> positions;
  /// The vertex indices of all polygons, one polygon after another.
  std::vector<std::uint32_t> corners;
  /// Polygon i has the corners first_corner[i] up to, but not including, first_corner[i + 1].
  std::vector<std::uint32_t> first_corner;
  /// Normals, of any length, and for each corner a number among them or kNoNormal. For shading: what is in
  /// front and behind is told by the order of corners. Both empty where no corner has one.
  std::vector<Vec3> normals;
  std::vector<std::uint32_t> corner_normals;
  static constexpr std::uint32_t kNoNormal = 0xFFFFFFFFu;
  /// Materials that polygons name, and for each polygon its material; both empty where the file names none.
  std::vector<Material> materials;
  std::vector<std::uint32_t> polygon_material;
  static constexpr std::uint32_t kNoMaterial = 0xFFFFFFFFu;
  /// Files of materials, as the file names them. read_polygon_soup reads them.
  std::vector<std::string> material_files;
  /// Those that were read.
  std::vector<std::filesystem::path> material_paths;
  /// What the file has and is not used, for people: "normals", "vertex colors".
  std::vector<std::string> ignored;

  std::size_t polygon_count() const { return first_corner.empty() ? 0 : first_corner.size() - 1; }
};

/// The extensions of the formats that are read and written: lower case, with the dot.
std::vector<std::string_view> mesh_extensions();
/// The formats' names in the same order, for help texts and messages: "PLY, OBJ, OFF or STL".
std::string mesh_format_names();

/// Reads a file. A file that begins as PLY does is PLY; otherwise its extension names the format; otherwise
/// its content does. Throws MeshError, with line or byte, where the file is missing, no regular file, empty,
/// truncated, malformed, in no known format, or without faces. Materials of OBJ get their colors from the
/// files that it names (MTL, `Kd`), beside it; a file that is missing is no error, but stands in `ignored`.
/// Cost O(bytes).
PolygonSoup read_polygon_soup(const std::filesystem::path& path);
/// The same from memory. `name` stands in messages, and its extension counts as a file's does.
PolygonSoup parse_polygon_soup(std::span<const std::byte> bytes, const std::string& name);

/// What became of the polygons.
struct PolygonReport {
  /// Polygons with more than three corners.
  std::size_t divided = 0;
  /// Of these, those with a corner that turns away from the others.
  std::size_t concave = 0;
  /// Of these, those that cross themselves. What they enclose is not defined; they are divided from their
  /// first corner.
  std::size_t crossing = 0;
  /// Polygons with fewer than three corners. They are left out.
  std::size_t skipped = 0;
};

struct Triangulation {
  std::vector<IndexedTriangle> triangles;
  /// For each triangle the polygon that it came from.
  std::vector<std::uint32_t> source_polygon;
  /// For each triangle the numbers of its corners in PolygonSoup::corners; only where the soup has normals.
  std::vector<IndexedTriangle> corners;
  PolygonReport report;
};
/// Divides each polygon into triangles over its corners. Convex polygons are divided from their first corner,
/// concave ones so that the triangles cover their inside; a hole may be joined to the outline by a bridge.
/// The rule for polygons that are not planar, have no area or cross themselves is in
/// mesh/polygons/polygon_triangles.h. Cost O(corners) for convex polygons, expected O(n log n) for a concave
/// one of n corners.
Triangulation triangulate(const PolygonSoup& soup);

/// A mesh and what became of its file.
struct LoadedMesh {
  TriangleMesh mesh;
  PolygonReport polygons;
  bool has_normals = false;
  /// As in PolygonSoup.
  std::vector<Material> materials;
  std::vector<std::string> ignored;
};
/// read_polygon_soup, triangulate and TriangleMesh::build in one. Throws MeshError as they do, and where no
/// face is left.
LoadedMesh load_mesh(const std::filesystem::path& path, const BuildOptions& options = {});
/// The same of a file that was read; `name` is used in messages.
LoadedMesh load_mesh(const PolygonSoup& soup, const std::string& name, const BuildOptions& options = {});
/// The mesh of load_mesh alone.
TriangleMesh read_mesh(const std::filesystem::path& path, const BuildOptions& options = {});

/// Writes a file whose format its extension names; PLY for the path "-", which is standard output. PLY is
/// binary, little endian, in double. OBJ and OFF have the shortest decimals that read back exactly. STL is
/// binary, in float: it loses precision and shared vertices. The file is written whole or not at all. Throws
/// UsageError (unknown extension, a coordinate beyond the range of STL) and SystemError.
void write_mesh(const std::filesystem::path& path, const TriangleMesh& mesh);

}  // namespace penumbra
