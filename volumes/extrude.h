// Extrude: sheets and the penumbra volume. (The umbra volume is in convex_umbra.h.)
//
// Rounding is in proportion to the caster's coordinates and to how far the volume reaches, not to the light's
// distance.
//
// Two products, since they serve different ends:
//  - Sheets are facets and cone patches where a tangent plane supports the caster locally. They are for
//    looking at. They close for convex casters only: at saddle vertices they do not.
//  - A volume is combinatorially closed. Inside is where its winding number is at least 1, and
//    ShadowMesh::guarantee says what that means.
//
// "Umbra and penumbra volumes" (2004), section 2.1, with two departures. There are facets also at edges
// between two mixed faces: the paper's rule misses knife edges under a large light. And volumes are sums of
// convex cells: the paper's loops do not contain the penumbra of casters that are not convex.
#pragma once

#include "penumbra/mesh/progress.h"
#include "penumbra/mesh/triangle_mesh.h"
#include "penumbra/volumes/shadow_mesh.h"
#include "penumbra/volumes/silhouettes.h"

namespace penumbra {

struct ExtrudeOptions {
  /// A sphere, in scene units, that the far end of every volume lies beyond. Radius 0: ten times the sphere
  /// around caster and light, or around the caster alone where the light is distant.
  Vec3 bound_center{0.0};
  double bound_radius = 0.0;
  /// Unless it is empty: umbra volumes end at its sides instead. It has to hold the caster.
  Bounds box{};
  /// Corners of the polygon around the disk, at least 3. In sheets: per full turn of a cone.
  int cone_segments = 16;
  /// One penumbra cell for each convex component. False: convex components are treated as all others.
  bool split_convex = true;
  /// Leave out penumbra cells of faces that look away from the whole light, in closed outward components in
  /// front of the light, where that is proved to change nothing. Faces that meet others, and those in front
  /// of which the component winds a negative number of times, keep their cells. False: every face gets one.
  bool assume_solid = true;
  /// With `assume_solid`: one penumbra cell for each patch of faces whose hull is proved to lie in the solid.
  /// False: one for each face. Both volumes contain the same points, but for the polygon around the disk.
  bool merge_faces = true;
  /// Written to tags.
  std::uint32_t object = 0;
  Progress progress;
};

/// Facets and cone patches of penumbra and umbra; kinds tell which. Far ends are beyond the bound. Triangles
/// face away from their volume. The guarantee is kNone.
///
/// A tangent plane of a band edge carries a facet by the sides of the edge's opposite vertices (of one vertex
/// at a boundary). It is a penumbra facet where none of them is on the disk's side and one is strictly
/// beyond, an umbra facet where none is beyond and one is strictly on the disk's side. A vertex on the plane
/// suits either. Where both are on it, the edge is inside a flat part of the surface and carries nothing. The
/// facet of a boundary face that lies in the plane is a penumbra facet. Edges that are not strictly in front
/// of the light's plane, and edges whose line meets the closed disk, carry none.
///
/// Cone patches fill, at each vertex, the directions between penumbra facets for which the tangent plane
/// separates all of the vertex's neighbors from the disk.
///
/// Throws UsageError for options outside their domain, Cancelled. Cost O(band · ring).
ShadowMesh extrude_sheets(const TriangleMesh& mesh, const CircularLight& light,
                          const Silhouettes& silhouettes, const ExtrudeOptions& options = {});

/// A volume that contains every point in front of the light's plane, within the bound, at which the caster
/// blocks some of the disk's area. It also contains the caster's own body. What lies in the light's plane or
/// behind it blocks nothing: a lamp may be part of its ceiling. Everything is in front of a distant light.
/// The guarantee is kContains.
///
/// The volume is a sum of convex cells. Each is everything that one convex body K can keep from some of P, a
/// polygon circumscribed to the disk (volumes/cells/penumbra_cell.h). K is
///  - the hull of a convex component in front of the light;
///  - in another closed outward component in front of the light, the hull of a patch of faces, all of them
///    not none-frontfacing, that the component contains (volumes/cells/convex_patches.h);
///  - else a triangle, clipped to the half-space in front.
/// Cells without interior are left out. The cell of a body that touches the disk is the whole half-space in
/// front. Inside a cell its winding number is 1, so that of the volume is the number of cells at a point.
///
/// Deterministic, cells on all cores. Throws UsageError for options outside their domain, Cancelled. Cost
/// O(F log F + v log v), v being the number of the cells' vertices: `cone_segments` and more for each cell.
ShadowMesh extrude_penumbra(const TriangleMesh& mesh, const CircularLight& light,
                            const Classification& classes, const ExtrudeOptions& options = {});

}  // namespace penumbra
