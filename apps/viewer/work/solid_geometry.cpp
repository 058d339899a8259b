#include "apps/viewer/work/solid_geometry.h"

#include <array>

#include "mesh/corner_normals.h"

namespace penumbra::viewer {
namespace {

constexpr double kSameSurface = 0.82;  // cosine of 35 degrees

}  // namespace

std::vector<SolidVertex> solid_triangles(const ShadowMesh& mesh, const Vec3& origin) {
  const std::vector<std::array<Vec3, 3>> normals =
      detail::corner_normals(mesh.positions, mesh.triangles, kSameSurface);
  std::vector<SolidVertex> out;
  out.reserve(3 * mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 n = normals[t][k], p = mesh.positions[mesh.triangles[t][k]] - origin;
      out.push_back({static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z),
                     static_cast<float>(n.x), static_cast<float>(n.y), static_cast<float>(n.z)});
    }
  return out;
}

}  // namespace penumbra::viewer
