// Analytic shapes, closed ones oriented outward. Lengths in scene units. Vertices lie on the ideal surface,
// so round shapes are inscribed. Sizes are positive, segments at least 3 (of a plane 1), levels and counts at
// least 0: asserted.
#pragma once

#include "penumbra/mesh/triangle_mesh.h"

namespace penumbra {

TriangleMesh make_triangle(const Vec3& a, const Vec3& b, const Vec3& c);
/// A square in the plane y = 0 facing +y, `half` from centre to side, split into 2 segments² triangles.
TriangleMesh make_plane(double half, int segments = 1);
TriangleMesh make_box(const Vec3& center, const Vec3& half);
/// An icosahedron subdivided `levels` times (20·4^levels faces), vertices on the sphere.
TriangleMesh make_icosphere(const Vec3& center, double radius, int levels);
/// Ring in the xz plane; 2·ring_segments·tube_segments faces.
TriangleMesh make_torus(const Vec3& center, double ring_radius, double tube_radius, int ring_segments,
                        int tube_segments);
/// Capped cylinder along y; 4·segments faces.
TriangleMesh make_cylinder(const Vec3& center, double radius, double half_height, int segments);
/// `count` independent triangles in a ball, for foliage-like tests; the same seed gives the same triangles
/// everywhere.
TriangleMesh make_random_triangles(const Vec3& center, double radius, double triangle_size, int count,
                                   std::uint64_t seed);

}  // namespace penumbra
