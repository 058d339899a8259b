// Small meshes as text and bytes, and checks that more than one test needs.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "penumbra/mesh/error.h"
#include "penumbra/mesh/io/polygon_soup.h"
#include "penumbra/mesh/triangle_mesh.h"

namespace penumbra::test {

inline std::span<const std::byte> bytes_of(const std::string& text) {
  return {reinterpret_cast<const std::byte*>(text.data()), text.size()};
}

inline PolygonSoup parse(const std::string& text, const std::string& name) {
  return parse_polygon_soup(bytes_of(text), name);
}

/// The message of the MeshError that `call` throws; empty (and a failure) where it throws none.
template <class Call>
std::string mesh_error_of(Call call) {
  try {
    call();
  } catch (const MeshError& error) {
    const std::string message = error.what();
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    EXPECT_NE(message.find("; "), std::string::npos) << "says what to do: " << message;
    return message;
  }
  ADD_FAILURE() << "no MeshError";
  return {};
}

inline void append_bytes(std::string& bytes, const auto& value, bool big_endian) {
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);
  if (big_endian) {
    std::reverse(raw, raw + sizeof value);
  }
  bytes.append(raw, sizeof value);
}

// A tetrahedron, outward, in each format.
inline constexpr std::array<std::array<float, 3>, 4> kTetraCorners = {
    {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
inline constexpr std::array<IndexedTriangle, 4> kTetraFaces = {{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};

inline std::string tetra_obj() {
  return "# a tetrahedron\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
}

inline std::string tetra_off() {
  return "OFF\n4 4 6\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
}

inline std::string tetra_ply_ascii() {
  return "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
         "element face 4\nproperty list uchar int vertex_indices\nend_header\n"
         "0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
}

/// With properties and an element to skip, in front, between and behind.
inline std::string tetra_ply_binary(bool big_endian) {
  std::string ply =
      std::string("ply\nformat ") + (big_endian ? "binary_big_endian" : "binary_little_endian") +
      " 1.0\ncomment made by hand\nelement extra 2\nproperty list ushort double values\n"
      "element vertex 4\nproperty uchar red\nproperty double x\nproperty float y\nproperty short z\n"
      "property float quality\nelement face 4\nproperty short flags\n"
      "property list uint ushort vertex_index\nproperty uchar alpha\nend_header\n";
  for (std::uint16_t size : {std::uint16_t{0}, std::uint16_t{2}}) {
    append_bytes(ply, size, big_endian);
    for (int i = 0; i < size; ++i) {
      append_bytes(ply, 1.5, big_endian);
    }
  }
  for (const auto& [x, y, z] : kTetraCorners) {
    append_bytes(ply, std::uint8_t{200}, big_endian);
    append_bytes(ply, static_cast<double>(x), big_endian);
    append_bytes(ply, y, big_endian);
    append_bytes(ply, static_cast<std::int16_t>(z), big_endian);
    append_bytes(ply, 0.5f, big_endian);
  }
  for (const IndexedTriangle& face : kTetraFaces) {
    append_bytes(ply, std::int16_t{-1}, big_endian);
    append_bytes(ply, std::uint32_t{3}, big_endian);
    for (const std::uint32_t v : face) {
      append_bytes(ply, static_cast<std::uint16_t>(v), big_endian);
    }
    append_bytes(ply, std::uint8_t{255}, big_endian);
  }
  return ply;
}

inline std::string tetra_stl_ascii() {
  std::string stl = "solid tetra\n";
  for (const IndexedTriangle& face : kTetraFaces) {
    stl += " facet normal 0 0 0\n  outer loop\n";
    for (const std::uint32_t v : face) {
      const auto& [x, y, z] = kTetraCorners[v];
      stl += "   vertex " + std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(z) + "\n";
    }
    stl += "  endloop\n endfacet\n";
  }
  return stl + "endsolid tetra\n";
}

inline std::string tetra_stl_binary() {
  std::string stl = "solid, yet binary";
  stl.resize(80, ' ');
  append_bytes(stl, std::uint32_t{4}, false);
  for (const IndexedTriangle& face : kTetraFaces) {
    stl.append(12, '\0');
    for (const std::uint32_t v : face) {
      for (const float x : kTetraCorners[v]) {
        append_bytes(stl, x, false);
      }
    }
    stl.append(2, '\0');
  }
  return stl;
}

/// Each format's tetrahedron with a file name for it.
inline std::vector<std::pair<std::string, std::string>> tetra_files() {
  return {{"t.obj", tetra_obj()},
          {"t.off", tetra_off()},
          {"ascii.ply", tetra_ply_ascii()},
          {"little.ply", tetra_ply_binary(false)},
          {"big.ply", tetra_ply_binary(true)},
          {"ascii.stl", tetra_stl_ascii()},
          {"binary.stl", tetra_stl_binary()}};
}

/// Corners of a face, sorted so that faces compare whatever their first corner and orientation.
using FaceKey = std::array<std::array<double, 3>, 3>;

inline std::vector<FaceKey> face_keys(std::span<const Vec3> positions,
                                      std::span<const IndexedTriangle> triangles) {
  std::vector<FaceKey> keys;
  for (const IndexedTriangle& t : triangles) {
    FaceKey key;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3& p = positions[t[k]];
      key[k] = {p.x + 0.0, p.y + 0.0, p.z + 0.0};
    }
    std::sort(key.begin(), key.end());
    keys.push_back(key);
  }
  std::sort(keys.begin(), keys.end());
  return keys;
}

/// What holds for every built mesh: edges and faces name each other rightly, fans are single, edges are
/// unique.
inline void expect_sound(const TriangleMesh& mesh) {
  ASSERT_EQ(mesh.face_edges().size(), mesh.triangles().size());
  ASSERT_EQ(mesh.source_triangles().size(), mesh.triangles().size());
  std::size_t sides = 0, wrong = 0;
  for (std::uint32_t f = 0; f < mesh.triangles().size(); ++f) {
    const IndexedTriangle& t = mesh.triangles()[f];
    for (std::size_t k = 0; k < 3; ++k) {
      const Edge& e = mesh.edges()[index(mesh.face_edges()[f][k])];
      const VertexId a{t[k]}, b{t[(k + 1) % 3]}, apex{t[(k + 2) % 3]};
      const bool on_left = e.left == FaceId{f} && e.from == a && e.to == b && e.left_apex == apex;
      const bool on_right = e.right == FaceId{f} && e.from == b && e.to == a && e.right_apex == apex;
      wrong += on_left == on_right;
    }
  }
  std::map<std::pair<VertexId, VertexId>, int> seen;
  std::map<VertexId, int> boundary_ends;
  for (const Edge& e : mesh.edges()) {
    sides += e.is_boundary() ? 1 : 2;
    wrong += e.left == kNone<FaceId> || (e.right_apex == kNone<VertexId>) != e.is_boundary();
    wrong += seen[std::minmax(e.from, e.to)]++ != 0;
    if (e.is_boundary()) {
      ++boundary_ends[e.from];
      ++boundary_ends[e.to];
    }
  }
  for (const auto& [vertex, ends] : boundary_ends) {
    wrong += ends != 2;
  }
  EXPECT_EQ(wrong, 0u);
  EXPECT_EQ(sides, 3 * mesh.triangles().size());

  std::size_t faces = 0;
  for (const Component& component : mesh.components()) {
    faces += component.faces.size();
    EXPECT_TRUE(std::is_sorted(component.faces.begin(), component.faces.end()));
  }
  EXPECT_EQ(faces, mesh.triangles().size());
}

inline int euler_characteristic(const TriangleMesh& mesh) {
  return static_cast<int>(mesh.positions().size()) - static_cast<int>(mesh.edges().size()) +
         static_cast<int>(mesh.triangles().size());
}

inline std::size_t boundary_edge_count(const TriangleMesh& mesh) {
  return static_cast<std::size_t>(std::ranges::count_if(mesh.edges(), &Edge::is_boundary));
}

/// A folder of its own for each test, removed afterwards.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "penumbra-XXXXXX").string();
    path_ = ::mkdtemp(pattern.data());
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  const std::filesystem::path& path() const { return path_; }
  std::size_t file_count() const {
    return static_cast<std::size_t>(
        std::distance(std::filesystem::directory_iterator(path_), std::filesystem::directory_iterator()));
  }

 private:
  std::filesystem::path path_;
};

inline std::string read_text(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

inline void write_text(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

}  // namespace penumbra::test
