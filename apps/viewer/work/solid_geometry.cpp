#include "apps/viewer/work/solid_geometry.h"

#include <cstdint>
#include <glm/geometric.hpp>

namespace penumbra::viewer {
namespace {

constexpr double kSameSurface = 0.82;  // cosine of 35 degrees

// Twice the area long.
std::vector<Vec3> face_normals(const ShadowMesh& mesh) {
  std::vector<Vec3> normals;
  normals.reserve(mesh.triangles.size());
  for (const IndexedTriangle& t : mesh.triangles) {
    const Vec3 &a = mesh.positions[t[0]], &b = mesh.positions[t[1]], &c = mesh.positions[t[2]];
    normals.push_back(glm::cross(b - a, c - a));
  }
  return normals;
}

// The triangles around each position.
std::vector<std::vector<std::uint32_t>> triangles_around(const ShadowMesh& mesh) {
  std::vector<std::vector<std::uint32_t>> around(mesh.positions.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for (const std::uint32_t corner : mesh.triangles[t]) around[corner].push_back(t);
  return around;
}

Vec3 unit_or_up(const Vec3& v) {
  const double length = glm::length(v);
  return length > 0.0 ? v / length : Vec3(0.0, 1.0, 0.0);
}

}  // namespace

std::vector<SolidVertex> solid_triangles(const ShadowMesh& mesh, const Vec3& origin) {
  const std::vector<Vec3> normals = face_normals(mesh);
  const auto around = triangles_around(mesh);
  std::vector<SolidVertex> out;
  out.reserve(3 * mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (const std::uint32_t corner : mesh.triangles[t]) {
      const Vec3 own = unit_or_up(normals[t]);
      Vec3 sum(0.0);
      for (const std::uint32_t other : around[corner])
        if (glm::dot(unit_or_up(normals[other]), own) > kSameSurface) sum += normals[other];
      const Vec3 n = unit_or_up(sum), p = mesh.positions[corner] - origin;
      out.push_back({static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z),
                     static_cast<float>(n.x), static_cast<float>(n.y), static_cast<float>(n.z)});
    }
  return out;
}

}  // namespace penumbra::viewer
