// Extrude, umbra: a volume in which the caster hides the whole disk.
//
// In: a mesh, a light and the classes of the mesh's faces. Out: a volume inside {O = 0}.
//
// "Umbra and penumbra volumes" (2004), section 2.1, takes the planes through the umbra silhouette that touch
// the disk with caster and disk on one side. For a convex body the umbra is the intersection of the
// half-spaces below those planes *and* of those below every face that looks at some of the disk. Without
// these caps it is too large. No cones are needed.
//
// The intersection is exact (a convex hull in the dual). Planes go through vertices of the caster as they
// are, so facets meet where they should. Only two things are rounded: the points where planes touch the disk,
// and the resulting vertices.
//
// Bodies are the closed components strictly in front of the light (all of them, where it is distant) that are
//  - convex, decided exactly: the umbra is all of it but for rounding;
//  - else star-shaped: the umbra is that of the convex kernel, which lies inside the component. A box that a
//    rotation has rounded is of this kind; its kernel is the box but for 1e-12 of it.
// Other components add nothing.
#pragma once

#include "penumbra/volumes/classify.h"
#include "penumbra/volumes/extrude.h"

namespace penumbra {

/// The union of the umbras of the mesh's bodies, one piece each; inside a piece its winding number is 1. The
/// bodies themselves count as umbra. The guarantee is kExact where the mesh is one convex body and nothing
/// else, otherwise kContained.
///
/// Kinds are kUmbraFacet (source: edge), kUmbraCap (source: face), and kFarCap where it is cut off beyond the
/// bound. All of a kernel's umbra but its far caps is kCell. The source of the last two is the component's
/// first face.
///
/// Deterministic, bodies on all cores. Throws UsageError for options outside their domain, Cancelled.
/// Expected cost O(F log F) for each body, in exact arithmetic: about 0.015 ms a face.
ShadowMesh convex_umbra(const TriangleMesh& mesh, const CircularLight& light, const Classification& classes,
                        const ExtrudeOptions& options = {});

}  // namespace penumbra
