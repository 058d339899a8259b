// Pipeline step 3: shadow geometry from silhouettes.
//
// Two products, since they serve different ends:
//  - `sheets`: facets and cone patches where a tangent plane supports the caster locally. For looking at, and
//  for the
//    D-buffer. They close only for convex casters: at saddle vertices they do not.
//  - `volume`: combinatorially closed, inside = winding number at least 1, with a guarantee
//  (ShadowMesh::guarantee).
//
// "Umbra and penumbra volumes" (2004), section 2.1, extended: facets also at edges between two mixed faces
// (the paper's rule misses knife edges under a large light), and volumes as sums of convex cells (the paper's
// loops do not contain the penumbra of casters that are not convex).
#pragma once

#include "penumbra/mesh/progress.h"
#include "penumbra/volumes/shadow_mesh.h"
#include "penumbra/volumes/silhouettes.h"

namespace penumbra {

struct ExtrudeOptions {
  Vec3 bound_center{0.0};     ///< sphere that the far end of every volume must lie beyond
  double bound_radius = 0.0;  ///< scene units; 0: ten times the sphere around caster and light
  /// Corners of the polygon circumscribed to the disk, at least 3 (sheets: per full turn of a cone).
  int cone_segments = 16;
  /// One cell per convex component where there are such; false: they are treated as the others are.
  bool split_convex = true;
  /// Closed outward components in front of the light have no point of negative winding number (as any that
  /// does not cross itself): faces that look away from the whole light then need no cells. false: every face
  /// gets one.
  bool assume_solid = true;
  /// With `assume_solid`: one cell per patch of faces whose hull is proved to lie in the solid; false: one
  /// per face. Both volumes contain the same points but for the polygon around the disk.
  bool merge_faces = true;
  std::uint32_t object = 0;  ///< written to tags
  Progress progress;
};

/// Facets and cone patches of the penumbra and the umbra (kinds tell which). For each tangent plane of a band
/// edge, by the sides of the edge's opposite vertices (one at a boundary): a penumbra facet where none is on
/// the disk's side and one is strictly beyond, an umbra facet where none is beyond and one is strictly on the
/// disk's side. A vertex on the plane suits either; where both are on it the edge is inside a flat part of
/// the surface and carries nothing, and the facet of a boundary face that lies in the plane is a penumbra
/// facet. Cone patches fill, at each vertex, the directions between penumbra facets for which the tangent
/// plane separates all the vertex's neighbours from the disk. Triangles face away from their volume. Far ends
/// are beyond the bound. Edges that are not strictly in front of the light's plane, or whose line meets the
/// closed disk, carry none. Cost O(band).
ShadowMesh extrude_sheets(const TriangleMesh& mesh, const DiskLight& light, const Silhouettes& silhouettes,
                          const ExtrudeOptions& options = {});

/// A volume containing every point in front of the light's plane, within the bound, at which the caster
/// blocks some of the disk's area; also the caster's own body. What lies in the light's plane or behind it
/// blocks nothing: a lamp may be part of its ceiling. A sum of convex cells, each everything that
/// one convex body K can keep from some of P (detail/penumbra_cell.h), P a polygon circumscribed to the disk:
/// K is the hull of a convex component in front of the light; of other closed outward components there the
/// hull of a patch of faces that the component contains (detail/convex_patches.h), the faces being those that
/// are not none-frontfacing; else a triangle clipped to the half-space in front.
/// Cells without interior are left out. A cell of a body that touches the disk is the half-space in front.
/// Inside a cell the winding number is 1; inside the volume it is the number of cells there. Deterministic,
/// cells on all cores. Throws Cancelled. Cost O(F log F + v · log v), v being the cells' vertices,
/// cone_segments and more of each.
ShadowMesh extrude_penumbra(const TriangleMesh& mesh, const DiskLight& light, const Classification& classes,
                            const ExtrudeOptions& options = {});

}  // namespace penumbra
