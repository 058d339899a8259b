#include "penumbra/mesh/io/polygon_soup.h"

#include <algorithm>
#include <fstream>
#include <system_error>

#include "mesh/io/cursor.h"
#include "mesh/io/formats.h"
#include "mesh/polygons/polygon_triangles.h"
#include "penumbra/mesh/error.h"

namespace penumbra {
namespace {

namespace fs = std::filesystem;

void check_soup(const PolygonSoup& soup, const std::string& name) {
  if (soup.polygon_count() == 0) {
    detail::fail_reading(name, "", "there are no faces in it",
                         "export the mesh with its faces, not as points");
  }
  for (std::size_t f = 0; f < soup.polygon_count(); ++f) {
    for (std::uint32_t i = soup.first_corner[f]; i < soup.first_corner[f + 1]; ++i) {
      if (soup.corners[i] >= soup.positions.size()) {
        detail::fail_reading(name, "",
                             "face " + std::to_string(f) + " uses vertex " + std::to_string(soup.corners[i]) +
                                 ", but there are only " + std::to_string(soup.positions.size()) +
                                 " (counted from 0)",
                             "correct the indices or export it again");
      }
    }
  }
}

std::vector<std::byte> read_bytes(const fs::path& path) {
  const std::string name = path.string();
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::not_found) {
    detail::fail_reading(name, "", "no such file", "check the path");
  }
  if (status.type() == fs::file_type::none) {
    detail::fail_reading(name, "", "cannot be opened: " + error.message(), "check the path and permissions");
  }
  if (status.type() != fs::file_type::regular) {
    const bool folder = status.type() == fs::file_type::directory;
    detail::fail_reading(name, "", folder ? "is a folder" : "is not a regular file", "name a mesh file");
  }
  std::ifstream in(path, std::ios::binary);
  const std::uintmax_t size = fs::file_size(path, error);
  if (!in || error) {
    detail::fail_reading(name, "", "cannot be opened", "check its permissions");
  }
  if (size == 0) {
    detail::fail_reading(name, "", "the file is empty", "export it again");
  }
  std::vector<std::byte> bytes(size);
  in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
  if (static_cast<std::uintmax_t>(in.gcount()) != size) {
    detail::fail_reading(name, "byte " + std::to_string(in.gcount()), "reading stopped", "check the disk");
  }
  return bytes;
}

}  // namespace

PolygonSoup read_polygon_soup(const fs::path& path) {
  return parse_polygon_soup(read_bytes(path), path.string());
}

PolygonSoup parse_polygon_soup(std::span<const std::byte> bytes, const std::string& name) {
  if (bytes.empty()) {
    detail::fail_reading(name, "", "the file is empty", "export it again");
  }
  PolygonSoup soup = detail::recognize_format(bytes, name).read(bytes, name);
  check_soup(soup, name);
  return soup;
}

Triangulation triangulate(const PolygonSoup& soup) {
  Triangulation result;
  result.triangles.reserve(soup.corners.size() - std::min(soup.corners.size(), 2 * soup.polygon_count()));
  std::vector<Vec3> corners;
  for (std::uint32_t f = 0; f < soup.polygon_count(); ++f) {
    const std::uint32_t* corner = soup.corners.data() + soup.first_corner[f];
    const std::uint32_t size = soup.first_corner[f + 1] - soup.first_corner[f];
    result.report.skipped += size < 3;
    result.report.divided += size > 3;
    const auto add = [&](const IndexedTriangle& t) {
      result.triangles.push_back({corner[t[0]], corner[t[1]], corner[t[2]]});
      result.source_polygon.push_back(f);
    };
    if (size == 3) add({0, 1, 2});
    if (size <= 3) continue;
    corners.clear();
    for (std::uint32_t k = 0; k < size; ++k) corners.push_back(soup.positions[corner[k]]);
    const detail::PolygonTriangles divided = detail::divide_polygon(corners);
    result.report.concave += divided.is_concave;
    result.report.crossing += divided.crosses_itself;
    std::ranges::for_each(divided.triangles, add);
  }
  return result;
}

LoadedMesh load_mesh(const fs::path& path, const BuildOptions& options) {
  const PolygonSoup soup = read_polygon_soup(path);
  const Triangulation triangulation = triangulate(soup);
  LoadedMesh loaded{.mesh = TriangleMesh::build(soup.positions, triangulation.triangles, options),
                    .polygons = triangulation.report};
  if (loaded.mesh.empty()) {
    detail::fail_reading(path.string(), "", "every face in it has fewer than three distinct corners",
                         "export the mesh at another scale or precision");
  }
  return loaded;
}

TriangleMesh read_mesh(const fs::path& path, const BuildOptions& options) {
  return load_mesh(path, options).mesh;
}

}  // namespace penumbra
