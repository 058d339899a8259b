// Random convex solids: of few corners and many, flat, needle-like, with coplanar faces, large and small
// before the light.
#pragma once

#include "penumbra/mesh/triangle_mesh.h"
#include "penumbra/volumes/predicates/predicates.h"
#include "tests/volumes/random_inputs.h"
#include "volumes/cells/convex_hull.h"

namespace penumbra::testing {

struct ConvexScene {
  TriangleMesh mesh;  ///< one closed convex component, strictly in front of the light
  CircularLight light = DiskLight{};
  Bounds box{};  ///< of caster and receivers
};

/// The corners of the k-th solid of a run, about the origin, not larger than 2.
inline std::vector<Vec3> random_corners(RandomInputs& random, int k) {
  std::vector<Vec3> corners;
  const int count = random.integer(4, 30);
  const Vec3 stretch = k % 5 == 3 ? Vec3(1.0, 1e-3, 1.0) : k % 5 == 4 ? Vec3(1e-2, 1.0, 1e-2) : Vec3(1.0);
  for (int i = 0; i < count; ++i) {
    const Vec3 p = k % 5 == 1   ? random.lattice_point(2) / 2.0  // coplanar and collinear corners
                   : k % 5 == 2 ? random.direction()
                                : random.uniform_point();
    corners.push_back(p * stretch);
  }
  return corners;
}

inline ConvexScene random_convex_scene(RandomInputs& random, int k, bool distant = false) {
  for (;;) {
    std::vector<Vec3> corners = random_corners(random, k);
    const std::vector<IndexedTriangle> hull = detail::convex_hull(corners);
    if (hull.empty()) continue;
    const Vec3 middle(random.uniform(-2, 2), random.uniform(3, 7), random.uniform(-2, 2));
    for (Vec3& p : corners) p = middle + p;  // rounded: no longer exactly a hull
    const std::vector<IndexedTriangle> moved = detail::convex_hull(corners);
    if (moved.empty()) continue;
    ConvexScene scene{.mesh = TriangleMesh::build(corners, moved)};
    if (distant) {
      const double length = std::pow(10.0, random.uniform(-3, 3));
      scene.light = DistantLight{length * Vec3(random.uniform(-0.7, 0.7), -1, random.uniform(-0.7, 0.7)),
                                 std::pow(10.0, random.uniform(-3, 2))};
    } else {
      scene.light = DiskLight{Vec3(0, 10, 0), Vec3(random.uniform(-0.2, 0.2), -1, random.uniform(-0.2, 0.2)),
                              std::pow(10.0, random.uniform(-3, 0.6))};
    }
    scene.box.add(Vec3(-6, 0, -6));
    scene.box.add(Vec3(6, 9, 6));
    bool in_front = true;
    for (const Vec3& p : scene.mesh.positions())
      in_front = in_front && side_of_light_plane(p, scene.light) == Sign::kPositive;
    if (in_front && scene.mesh.components().size() == 1) return scene;
  }
}

}  // namespace penumbra::testing
