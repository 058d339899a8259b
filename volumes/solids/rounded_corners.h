// Corners of an exact polyhedron that rounding has split.
#pragma once

#include "volumes/solids/solid_mesher.h"

namespace penumbra::detail {

/// Where more than three planes meet in one corner, rounded planes meet in several, some units in the last
/// place apart, with triangles between them that have no meaningful normal. Makes one vertex of those, and
/// drops the triangles. Changes nothing where the surface, which is a sphere's (V - E + F = 2, each edge once
/// in each direction), would not stay one. O(V log V) where few have the same x.
void merge_rounded_corners(SolidMesh& mesh);

}  // namespace penumbra::detail
