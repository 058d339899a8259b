// What every solid has to be, whatever it is a solid of.
#pragma once

#include <gtest/gtest.h>

#include "penumbra/volumes/checks/validate.h"
#include "penumbra/volumes/shadow_mesh.h"

namespace penumbra {

inline void expect_sound(const ShadowMesh& mesh) {
  const SurfaceFindings f = check_surface(mesh.positions, mesh.triangles);
  EXPECT_TRUE(f.closed());
  EXPECT_TRUE(f.degenerate.empty());
  EXPECT_TRUE(f.self_intersections.empty());
  EXPECT_TRUE(f.bounds_a_volume);
  const TriangleMesh built = TriangleMesh::build(mesh.positions, mesh.triangles);
  EXPECT_TRUE(built.is_closed());
  EXPECT_EQ(built.report().non_manifold_edges, 0u);
  EXPECT_EQ(built.report().non_manifold_vertices, 0u);
}

/// Vertices - edges + faces: 2 for each piece without a tunnel.
inline long euler_characteristic(const ShadowMesh& mesh) {
  return static_cast<long>(mesh.positions.size()) - static_cast<long>(mesh.triangles.size()) / 2;
}

}  // namespace penumbra
