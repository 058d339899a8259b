// The volumes of one caster under one circular light, near or distant. The steps, in the order in which they
// happen:
//
//   mesh/triangle_mesh.h     positions and triangles → half-edge mesh
//   volumes/classify.h       mesh, light → a class per face: all-frontfacing, none-frontfacing, mixed
//   volumes/silhouettes.h    classes                 → umbra silhouette, penumbra silhouette, band
//   volumes/extrude.h        silhouettes             → sheets: facets and cone patches, to look at
//                            classes                 → penumbra volume
//   volumes/convex_umbra.h   classes                 → umbra volume
//
// build_shadow_volumes runs them all. Images are made elsewhere; checks of the volumes with CGAL are in
// volumes/checks/checks.h.
#pragma once

#include "penumbra/mesh/stage_clock.h"
#include "penumbra/volumes/classify.h"
#include "penumbra/volumes/convex_umbra.h"
#include "penumbra/volumes/disk_light.h"
#include "penumbra/volumes/extrude.h"
#include "penumbra/volumes/silhouettes.h"

namespace penumbra {

/// What to make beside the classes and silhouettes, which are always made.
struct VolumeOptions {
  /// Facets and cone patches, see extrude_sheets. They are no volume.
  bool sheets = false;
  /// A volume that contains {O < 1}, see extrude_penumbra.
  bool penumbra = true;
  /// A volume inside {O = 0}, see convex_umbra. Exact arithmetic: the slowest step.
  bool umbra = true;
  /// How far the volumes reach, how finely cones are divided, the object's number in the tags, and the
  /// progress of the whole call.
  ExtrudeOptions extrude{};
};

struct ShadowVolumes {
  Classification classes;
  Silhouettes silhouettes;
  /// Each of these is empty, with guarantee kNone, unless it was asked for.
  ShadowMesh sheets;
  ShadowMesh penumbra;
  ShadowMesh umbra;
  /// "classify", "silhouettes", then "sheets", "penumbra" and "umbra" as far as they were asked for.
  std::vector<StageTime> stages;
};

/// Classifies the caster's faces, finds its silhouettes, and extrudes what `options` asks for. Mesh and light
/// are in the same frame, which is that of the results. Deterministic, on all cores.
///
/// Throws MeshError for an empty mesh; UsageError for a light that require_valid refuses, or options outside
/// their domain (whether or not something is extruded); Cancelled. Cost O(F + E), and that of what is
/// extruded.
ShadowVolumes build_shadow_volumes(const TriangleMesh& mesh, const CircularLight& light,
                                   const VolumeOptions& options = {});

/// Throws UsageError unless the light is finite, its normal or direction is not 0, and its radius is at least
/// 0 or its angle from 0 to below 180 degrees.
void require_valid(const CircularLight& light);
inline void require_valid(const DiskLight& light) {
  require_valid(CircularLight(light));
}
inline void require_valid(const DistantLight& light) {
  require_valid(CircularLight(light));
}

}  // namespace penumbra
