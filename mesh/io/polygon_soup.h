// Reading and writing meshes: OBJ, PLY (ASCII, binary of either byte order), OFF, STL (ASCII, binary).
//
// In: a path (the format is told by content where a magic word exists, else by extension). Out: positions in
// double and polygons as index lists, exactly as the file has them; `triangulate` fans them. Nothing is
// trusted: counts are checked against the file's size before memory is reserved, every index is checked,
// every coordinate must be finite.
//
// The readers are our own: OpenMesh's read single precision only and trust the counts they find, and a bad
// file must give a clear message. Skipped are normals, colours, texture coordinates, and what is not vertices
// and faces.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "penumbra/mesh/triangle_mesh.h"
#include "penumbra/mesh/types.h"

namespace penumbra {

struct PolygonSoup {
  std::vector<Vec3> positions;
  std::vector<std::uint32_t> corners;       ///< all polygons' vertex indices, one after another
  std::vector<std::uint32_t> first_corner;  ///< polygon i: corners[first_corner[i] .. first_corner[i+1])
  std::size_t polygon_count() const { return first_corner.empty() ? 0 : first_corner.size() - 1; }
};

/// Throws MeshError: missing, a folder or device, empty, truncated, malformed (with line or byte), no faces.
/// Cost O(bytes).
PolygonSoup read_polygon_soup(const std::filesystem::path& path);
/// The same from memory; `name` is used in messages and its extension as the format's hint.
PolygonSoup parse_polygon_soup(std::span<const std::byte> bytes, const std::string& name);

struct Triangulation {
  std::vector<IndexedTriangle> triangles;
  std::vector<std::uint32_t> source_polygon;  ///< per triangle
  std::size_t fanned_polygons = 0;            ///< polygons with more than three corners
  std::size_t skipped_polygons = 0;           ///< polygons with fewer than three corners (left out)
};
/// Fans each polygon from its first corner.
Triangulation triangulate(const PolygonSoup& soup);

/// read_polygon_soup, triangulate and TriangleMesh::build. Throws MeshError also where no face is left.
TriangleMesh read_mesh(const std::filesystem::path& path, const BuildOptions& options = {});

/// Writes PLY (binary little endian, double; also for the path "-", standard output), OBJ, OFF (both with the
/// shortest decimals that read back exactly) or STL (binary, float, hence lossy) by extension; whole or not
/// at all, see write_file.h. Throws UsageError (unknown extension, a coordinate beyond STL's range) and
/// SystemError.
void write_mesh(const std::filesystem::path& path, const TriangleMesh& mesh);

}  // namespace penumbra
