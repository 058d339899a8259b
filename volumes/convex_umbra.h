// Pipeline step 3, umbra: where the caster hides the whole disk.
//
// In: mesh, light and classes (results of volumes.h). Out: a volume inside of {O = 0}.
//
// "Umbra and penumbra volumes" (2004), section 2.1, takes the planes through the umbra silhouette that touch
// the disk with caster and disk on one side. For a convex body the umbra is the intersection of those
// half-spaces *and* of those below every face that looks at some of the disk: without these caps it is too
// large. No cones are needed. Intersected exactly (a convex hull in the dual), every plane through
// vertices of the caster as they are, so that facets meet where they should; only the points where planes
// touch the disk, and the resulting vertices, are rounded.
//
// Bodies are the closed components strictly in front of the light that are
//  - convex, decided exactly: the umbra is all of it but for rounding;
//  - else star-shaped: the umbra of the convex kernel, which is inside of the component. Boxes that a
//  rotation
//    has rounded are of this kind; their kernel is the box but for 1e-12 of it.
// Others add nothing.
#pragma once

#include "penumbra/volumes/classify.h"
#include "penumbra/volumes/extrude.h"

namespace penumbra {

/// Labelled `exact` where the mesh is one convex body and nothing else, `contained` otherwise (the union over
/// bodies, one piece each). Inside a piece the winding number is 1. Kinds: kUmbraFacet (source: edge),
/// kUmbraCap (source: face), kFarCap where it is cut off beyond the bound, and kCell for all of a kernel's
/// but its far caps; source of the last two: the component's first face. The bodies themselves count as
/// umbra. Deterministic. Throws UsageError for options outside their domain, Cancelled. Expected cost O(F log
/// F) a body, in exact arithmetic: about 0.015 ms a face, bodies on all cores.
ShadowMesh convex_umbra(const TriangleMesh& mesh, const DiskLight& light, const Classification& classes,
                        const ExtrudeOptions& options = {});

}  // namespace penumbra
