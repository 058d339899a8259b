#include "mesh/corner_normals.h"

#include <cstdint>
#include <glm/geometric.hpp>

namespace penumbra::detail {
namespace {

// Twice the area long.
std::vector<Vec3> face_normals(std::span<const Vec3> positions, std::span<const IndexedTriangle> triangles) {
  std::vector<Vec3> normals;
  normals.reserve(triangles.size());
  for (const IndexedTriangle& t : triangles) {
    const Vec3 &a = positions[t[0]], &b = positions[t[1]], &c = positions[t[2]];
    normals.push_back(glm::cross(b - a, c - a));
  }
  return normals;
}

// The triangles around each position.
std::vector<std::vector<std::uint32_t>> triangles_around(std::size_t count,
                                                         std::span<const IndexedTriangle> triangles) {
  std::vector<std::vector<std::uint32_t>> around(count);
  for (std::uint32_t t = 0; t < triangles.size(); ++t)
    for (const std::uint32_t corner : triangles[t]) around[corner].push_back(t);
  return around;
}

Vec3 unit_or_up(const Vec3& v) {
  const double length = glm::length(v);
  return length > 0.0 ? v / length : Vec3(0.0, 1.0, 0.0);
}

}  // namespace

std::vector<std::array<Vec3, 3>> corner_normals(std::span<const Vec3> positions,
                                                std::span<const IndexedTriangle> triangles,
                                                double least_cosine) {
  const std::vector<Vec3> normals = face_normals(positions, triangles);
  const auto around = triangles_around(positions.size(), triangles);
  std::vector<std::array<Vec3, 3>> out(triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const Vec3 own = unit_or_up(normals[t]);
    for (std::size_t k = 0; k < 3; ++k) {
      Vec3 sum(0.0);
      for (const std::uint32_t other : around[triangles[t][k]])
        if (glm::dot(unit_or_up(normals[other]), own) > least_cosine) sum += normals[other];
      out[t][k] = unit_or_up(sum);
    }
  }
  return out;
}

}  // namespace penumbra::detail
