// Twenty-nine lights about a mesh, most of them degenerate for it on purpose.
#pragma once

#include <glm/geometric.hpp>
#include <string>
#include <vector>

#include "penumbra/mesh/triangle_mesh.h"
#include "penumbra/volumes/disk_light.h"

namespace penumbra::testing {

struct Pose {
  std::string name;
  CircularLight light = DiskLight{};
  double scale = 1.0;  ///< of the mesh and of its light
  Vec3 offset{0.0};    ///< then added to both
};

/// For a mesh with at least one face.
inline std::vector<Pose> light_poses(const TriangleMesh& mesh) {
  const Bounds& box = mesh.bounds();
  const Vec3 c = box.center(), down(0, -1, 0);
  const double size = box.radius();
  const IndexedTriangle& face = mesh.triangles()[mesh.triangles().size() / 2];
  const Vec3 a = mesh.positions()[face[0]], b = mesh.positions()[face[1]], d = mesh.positions()[face[2]];
  const Vec3 along = b - a;
  // The products in normal·along cancel exactly.
  const Vec3 across = along.x != 0.0 || along.y != 0.0 ? Vec3(-along.y, along.x, 0) : Vec3(1, 0, 0);
  const DiskLight above{c + Vec3(0.1, 3, 0.2) * size, down, 0.2 * size};
  const Vec3 to_third = d - a, sunbeam = glm::normalize(Vec3(0.1, -1.0, 0.2));
  const auto with_radius = [&](double radius) { return DiskLight{above.center, down, radius}; };
  return {
      {"above", above},
      {"radius 0", with_radius(0.0)},
      {"radius 1e-300", with_radius(1e-300)},
      {"huge", with_radius(1e3 * size)},
      {"immense", with_radius(1e8 * size)},
      {"a vertex in the light's plane", {{a.x + 2.0 * size, a.y, a.z}, down, 0.3 * size}},
      {"a vertex at the center", {a, down, 0.1 * size}},
      {"an edge in the light's plane, through the disk", {a, across, 0.5 * size}},
      {"an edge in the light's plane, beside the disk", {a + 64.0 * along, across, glm::length(along)}},
      {"the center on an edge's line", {b + along, down, 0.1 * size}},
      {"the center in a face's plane", {a + 2.0 * along + 2.0 * (d - a), down, 0.2 * size}},
      {"radius 0 in a face's plane", {a + 2.0 * along + 2.0 * (d - a), down, 0.0}},
      {"inside", {c, down, 0.05 * size}},
      {"touching the top", {{c.x, box.high.y, c.z}, down, 0.5 * size}},
      {"beside, the plane cuts through", {c + Vec3(2 * size, 0, 0), down, 0.4 * size}},
      {"everything behind", {c - Vec3(0, 3 * size, 0), down, 0.2 * size}},
      {"oblique, a tiny normal", {above.center, Vec3(1e-40, -2e-40, 0.5e-40), size}},
      {"the light 1e7 sizes away", {c + Vec3(0, 1e7, 0) * size, down, size}},
      {"all 1e7 from the origin", above, 1.0, Vec3(1e7, -1e7, 1e7)},
      {"all 1e-9 as large", above, 1e-9},
      {"as the sun, 1e9 sizes away", {c - 1e9 * size * sunbeam, sunbeam, 4.6e6 * size}},
      {"as the sun, 1e12 sizes away", {c - 1e12 * size * sunbeam, sunbeam, 4.6e9 * size}},
      {"1e6 sizes beside, the plane cuts through", {c + Vec3(1e6, 0, 0) * size, down, 1e4 * size}},
      {"a sun", DistantLight{{0.1, -1.0, 0.2}, 0.53}},
      {"a sun of angle 0 along an edge", DistantLight{along, 0.0}},
      {"a sun along an edge, in a face's plane", DistantLight{along, 30.0}},
      {"a sun in a face's plane, of a tiny direction", DistantLight{-1e-40 * (along + to_third), 1.0}},
      {"half the sky, all 1e-9 as large", DistantLight{down, 170.0}, 1e-9},
      {"a sun, all 1e7 from the origin", DistantLight{{-3.0, -1.0, 0.5}, 0.53}, 1.0, Vec3(1e7, -1e7, 1e7)},
  };
}

}  // namespace penumbra::testing
