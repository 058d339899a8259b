// How much of the disk chords leave: the formulas that turn an edge seen from a receiver into visibility.
//
// A chord is a line in the light's plane, in units where the disk is the unit disk: the half-plane a·p + δ ≥
// 0 with a unit, so that δ is the signed distance of the disk's center from the line, positive where the
// center is inside. Each formula has a twin in shaders/disk_area.glsl; a test runs both on the same points.
#pragma once

#include <glm/vec2.hpp>

#include "penumbra/mesh/types.h"

namespace penumbra {

struct Chord {
  glm::dvec2 normal{0.0};  ///< unit, into the half-plane
  double delta = 1.0;  ///< signed distance of the center; 1 and more: the whole disk, -1 and less: nothing
};

/// The chord that the plane n·(p - x) ≥ 0 cuts from the disk of radius r in the plane z = 0 around the
/// origin, for x in the light's frame: δ = -n·x / (r |n_xy|). A plane parallel to the disk gives ±infinity.
/// "Umbra and penumbra volumes" (2004), eq. 2 and 3, done without stored distances.
Chord chord_of_plane(const Vec3& n, const Vec3& x, double r);

/// The plane's normal through receiver x and the edge a → b: (a - x) × (b - a). (The product (a - x) × (b -
/// x) is the same vector but cancels.)
Vec3 edge_plane(const Vec3& x, const Vec3& a, const Vec3& b);

/// Area fraction of the half-plane: 1/2 + (asin δ + δ√(1-δ²))/π, clamped outside [-1, 1].
double half_plane_area(double delta);

/// The same within 2.5e-5 and without an arc sine: with s = |δ|, tail = (1-s)^1.5 (0.5 + 0.11275 s - 0.01345
/// s²).
double half_plane_area_fast(double delta);

/// Area fraction common to two half-planes; exact up to rounding. By Green's theorem twice the area is δ1 L1
/// + δ2 L2 + the arc's angle, L the length of each chord that the other half-plane keeps.
double two_half_planes_area(const Chord& one, const Chord& two);

}  // namespace penumbra
