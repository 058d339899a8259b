// What holds of every volume and silhouette whatever the input: closed, finite, balanced, and no silhouette
// edge's line meets the disk.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "penumbra/volumes/volumes.h"
#include "tests/volumes/light_samples.h"

namespace penumbra::testing {

inline ::testing::AssertionResult is_finite(const ShadowMesh& volume) {
  for (const Vec3& p : volume.positions) {
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
      return ::testing::AssertionFailure() << "a vertex is not finite";
  }
  return ::testing::AssertionSuccess();
}

inline ::testing::AssertionResult is_sound(const ShadowMesh& volume) {
  std::vector<std::array<std::uint32_t, 2>> forward, backward;
  for (const IndexedTriangle& t : volume.triangles) {
    for (int k = 0; k < 3; ++k) {
      forward.push_back({t[k], t[(k + 1) % 3]});
      backward.push_back({t[(k + 1) % 3], t[k]});
    }
  }
  std::sort(forward.begin(), forward.end());
  std::sort(backward.begin(), backward.end());
  if (forward != backward) return ::testing::AssertionFailure() << "the volume is open";
  return is_finite(volume);
}

/// As many edges leave a vertex as arrive, with the face that looks at more of the light on the left.
inline ::testing::AssertionResult is_balanced(const TriangleMesh& mesh, const std::vector<EdgeId>& edges,
                                              const Classification& classes) {
  std::map<VertexId, int> balance;
  for (const EdgeId e : edges) {
    const Edge& edge = mesh.edges()[index(e)];
    const int turn = classes.faces[index(edge.left)] > classes.faces[index(edge.right)] ? 1 : -1;
    balance[edge.from] += turn;
    balance[edge.to] -= turn;
  }
  for (const auto& [vertex, sum] : balance) {
    if (sum != 0) return ::testing::AssertionFailure() << "vertex " << index(vertex) << " is out of balance";
  }
  return ::testing::AssertionSuccess();
}

/// Builds everything and asserts (fatally) that it is sound.
inline void expect_sound(const TriangleMesh& mesh, const CircularLight& light, ShadowVolumes& v,
                         const ExtrudeOptions& extrude = {}) {
  SCOPED_TRACE(text_of(light));
  VolumeOptions options;
  options.sheets = true;
  options.extrude = extrude;
  v = build_shadow_volumes(mesh, light, options);
  ASSERT_TRUE(is_sound(v.penumbra));
  ASSERT_TRUE(is_sound(v.umbra));
  ASSERT_TRUE(is_finite(v.sheets));
  if (!mesh.is_closed()) return;
  ASSERT_TRUE(is_balanced(mesh, v.silhouettes.umbra, v.classes));
  ASSERT_TRUE(is_balanced(mesh, v.silhouettes.penumbra, v.classes));
  for (const auto* edges : {&v.silhouettes.umbra, &v.silhouettes.penumbra}) {
    for (const EdgeId e : *edges) {
      const Edge& edge = mesh.edges()[index(e)];
      ASSERT_EQ(line_outside_disk(mesh.position(edge.from), mesh.position(edge.to), light), Sign::kPositive);
    }
  }
}

}  // namespace penumbra::testing
