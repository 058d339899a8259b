// What tests of extruded volumes share: a light, casters, and questions to a volume.
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "penumbra/volumes/volumes.h"
#include "tests/volumes/light_samples.h"
#include "tests/volumes/random_inputs.h"
#include "tests/volumes/triangle_tree.h"

namespace penumbra::testing {

/// Shines down from a height of 10.
inline const DiskLight kLight{{0, 10, 0}, {0, -1, 0}, 0.8};

/// Classes, silhouettes, penumbra and umbra, and the sheets if asked for.
inline ShadowVolumes build(const TriangleMesh& mesh, const CircularLight& light, bool sheets = false) {
  VolumeOptions options;
  options.sheets = sheets;
  return build_shadow_volumes(mesh, light, options);
}

/// How often each directed half-edge is used more than its opposite.
inline std::map<std::pair<std::uint32_t, std::uint32_t>, int> unmatched(
    const std::vector<IndexedTriangle>& triangles) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> count;
  for (const IndexedTriangle& t : triangles) {
    for (int i = 0; i < 3; ++i) {
      ++count[{t[i], t[(i + 1) % 3]}];
      --count[{t[(i + 1) % 3], t[i]}];
    }
  }
  std::erase_if(count, [](const auto& entry) { return entry.second <= 0; });
  return count;
}

/// The winding number of the volume's surface around x.
inline int winding_at(const ShadowMesh& volume, const CircularLight& light, const Vec3& x) {
  RandomInputs random(1);
  const TriangleTree tree(volume.positions, volume.triangles);
  return winding_number(tree, x, unshadowed_point(light, bounds_of(volume.positions), 1.0), 0.1, random);
}

/// A thin roof: two mixed faces meet in a knife edge under a large light, and no face looks at all of it. The
/// paper's rule finds no penumbra silhouette; ours a penumbra.
inline TriangleMesh knife() {
  const std::vector<Vec3> p{{-1, 5.6, 0}, {1, 5.6, 0},  {-1, 4, -0.1},
                            {1, 4, -0.1}, {-1, 4, 0.1}, {1, 4, 0.1}};
  const std::vector<IndexedTriangle> t{{0, 1, 3}, {0, 3, 2}, {0, 4, 5}, {0, 5, 1},
                                       {2, 3, 5}, {2, 5, 4}, {0, 2, 4}, {1, 5, 3}};
  return TriangleMesh::build(p, t);
}

}  // namespace penumbra::testing
