// The story of Penumbra's geometry, in the order in which it happens:
//
//   mesh/triangle_mesh.h   positions and triangles → half-edge mesh
//   volumes/classify.h     mesh, disk light        → class per face: all-frontfacing, none-frontfacing, mixed
//   volumes/silhouettes.h   classes                 → umbra silhouette, penumbra silhouette, band
//   volumes/extrude.h      silhouettes             → sheets (facets, cone patches), penumbra and umbra
//   volumes
//
// and one call that runs them all. volumes/checks/checks.h (target penumbra::checks) adds what is verified with
// CGAL.
#pragma once

#include "penumbra/volumes/classify.h"
#include "penumbra/volumes/disk_light.h"
#include "penumbra/volumes/extrude.h"
#include "penumbra/volumes/silhouettes.h"

namespace penumbra {

struct ShadowVolumes {
  Classification classes;
  Silhouettes silhouettes;
  ShadowMesh sheets;  ///< empty unless asked for
  ShadowMesh penumbra;
  ShadowMesh umbra;
};

struct VolumeOptions {
  ExtrudeOptions extrude;
  bool sheets = false;
};

/// Everything for one caster, positions in world space. Throws MeshError for an empty mesh, UsageError for
/// options outside their domain or a light that is not finite, has a zero normal or a negative radius.
ShadowVolumes build_shadow_volumes(const TriangleMesh& mesh, const DiskLight& light,
                                   const VolumeOptions& options = {});

/// Throws UsageError unless the light is finite, its normal not 0 and its radius at least 0.
void require_valid(const DiskLight& light);

}  // namespace penumbra
