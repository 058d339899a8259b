// Analytic shapes as meshes, so that tests and examples need no files.
//
// Lengths are in scene units. Closed shapes are oriented outward. Vertices lie on the ideal surface, so round
// shapes are inscribed. Sizes must be positive, segments at least 3 (of a plane at least 1), levels and
// counts at least 0: this is asserted.
#pragma once

#include "penumbra/mesh/triangle_mesh.h"

namespace penumbra {

TriangleMesh make_triangle(const Vec3& a, const Vec3& b, const Vec3& c);
/// A square in the plane y = 0 that faces +y, `half` from its center to its sides, of 2·segments² triangles.
TriangleMesh make_plane(double half, int segments = 1);
/// Sides parallel to the axes, `half` from the center to the sides; 12 faces.
TriangleMesh make_box(const Vec3& center, const Vec3& half);
/// An icosahedron, subdivided `levels` times, with all vertices on the sphere; 20·4^levels faces.
TriangleMesh make_icosphere(const Vec3& center, double radius, int levels);
/// Its ring lies in the xz plane; 2·ring_segments·tube_segments faces.
TriangleMesh make_torus(const Vec3& center, double ring_radius, double tube_radius, int ring_segments,
                        int tube_segments);
/// A capped cylinder along y; 4·segments faces.
TriangleMesh make_cylinder(const Vec3& center, double radius, double half_height, int segments);
/// `count` separate triangles in a ball, like foliage. The same seed gives the same triangles on every
/// machine.
TriangleMesh make_random_triangles(const Vec3& center, double radius, double triangle_size, int count,
                                   std::uint64_t seed);

}  // namespace penumbra
