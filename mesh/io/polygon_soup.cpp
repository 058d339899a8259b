#include "penumbra/mesh/io/polygon_soup.h"

#include <algorithm>
#include <utility>

#include "mesh/io/cursor.h"
#include "mesh/io/formats.h"
#include "mesh/io/material_colors.h"
#include "mesh/io/read_file.h"
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

/// Fails for what is a mesh file only after it was unpacked or converted.
void refuse_wrapped(std::span<const std::byte> bytes, const std::string& name) {
  using namespace std::string_view_literals;
  static constexpr std::pair<std::string_view, const char*> kPacked[] = {{"\x1F\x8B"sv, "gzip"},
                                                                         {"PK\3\4"sv, "zip"},
                                                                         {"BZh"sv, "bzip2"},
                                                                         {"\xFD"
                                                                          "7zXZ\0"sv,
                                                                          "xz"},
                                                                         {"\x28\xB5\x2F\xFD"sv, "zstd"},
                                                                         {"7z\xBC\xAF\x27\x1C"sv, "7z"}};
  const std::string_view text = detail::as_text(bytes);
  for (const auto& [begin, format] : kPacked)
    if (text.starts_with(begin))
      detail::fail_reading(name, "", std::string("is compressed (") + format + ")", "unpack it first");
  const bool every_other_is_0 =
      text.size() >= 4 && text[0] != 0 && text[1] == 0 && text[2] != 0 && text[3] == 0;
  const bool is_wide = text.starts_with("\xFF\xFE"sv) || text.starts_with("\xFE\xFF"sv) ||
                       (every_other_is_0 && !detail::has_binary_stl_size(bytes));
  if (is_wide) detail::fail_reading(name, "", "is text in UTF-16", "save it as UTF-8");
}

}  // namespace

PolygonSoup read_polygon_soup(const fs::path& path) {
  PolygonSoup soup = parse_polygon_soup(detail::read_bytes(path), path.string());
  for (const std::string& file : soup.material_files) detail::add_colors(soup, path.parent_path(), file);
  return soup;
}

PolygonSoup parse_polygon_soup(std::span<const std::byte> bytes, const std::string& name) {
  if (bytes.empty()) {
    detail::fail_reading(name, "", "the file is empty", "export it again");
  }
  refuse_wrapped(bytes, name);
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
      const std::uint32_t first = soup.first_corner[f];
      if (!soup.corner_normals.empty()) result.corners.push_back({first + t[0], first + t[1], first + t[2]});
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
  return load_mesh(read_polygon_soup(path), path.string(), options);
}

LoadedMesh load_mesh(const PolygonSoup& soup, const std::string& name, const BuildOptions& options) {
  const Triangulation triangulation = triangulate(soup);
  LoadedMesh loaded{.mesh = TriangleMesh::build(soup.positions, triangulation.triangles, options),
                    .polygons = triangulation.report,
                    .has_normals = !soup.corner_normals.empty(),
                    .materials = soup.materials,
                    .ignored = soup.ignored};
  if (loaded.mesh.empty()) {
    detail::fail_reading(name, "", "every face in it has fewer than three distinct corners",
                         "export the mesh at another scale or precision");
  }
  return loaded;
}

TriangleMesh read_mesh(const fs::path& path, const BuildOptions& options) {
  return load_mesh(path, options).mesh;
}

}  // namespace penumbra
