// Exact signs. Nothing else decides signs for classification, topology and certificates.
//
// Every predicate returns the exact sign for the finite doubles that it is given. Three tiers of arithmetic
// are asked in turn: plain double with a derived bound on its error (volumes/predicates/filtered.h),
// intervals, and exact numbers (CGAL). There is no tolerance. Where the first tier overflows or underflows, a
// later one decides. The radius enters by its square, so everything is rational in the inputs. The
// floating-point environment has to be the default one: rounding to nearest, subnormals not flushed.
//
// Lights are disks or distant (disk_light.h). Below, w = center - weight·a leads from a to the light's
// center; of a distant light it is the direction -m.
//
// The laws at each function hold exactly and are tested. Cost O(1) each.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "penumbra/mesh/types.h"
#include "penumbra/volumes/disk_light.h"

namespace penumbra {

enum class Sign : std::int8_t { kNegative = -1, kZero = 0, kPositive = 1 };

/// How much of the disk a face looks at. Both outer classes are strict: a face whose plane touches the closed
/// disk is mixed.
enum class FaceClass : std::uint8_t { kNoneFront = 0, kMixed = 1, kAllFront = 2 };

/// Class of the face (a, b, c) against the closed disk, by the extremes of N·(p - a), N = (b - a) × (c - a),
/// over its points p: with d = N·w all-frontfacing iff d > 0 and d²(m·m) > r²|N × m|² (of a distant light, d²
/// > r²|N × m|²), none-frontfacing likewise with d < 0, else mixed. A degenerate face (N = 0) is mixed. Laws:
/// swapping two vertices swaps kAllFront and kNoneFront; rotating the vertices, scaling everything or the
/// normal alone (of a distant light, the direction alone or the vertices alone) by a power of two changes
/// nothing.
FaceClass classify_face(const Vec3& a, const Vec3& b, const Vec3& c, const CircularLight& light);

/// Sign of det(b - a, c - a, d - a): positive when d lies on the side from which (a, b, c) runs
/// counter-clockwise. Laws: odd under transposition, invariant under even permutations.
Sign orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// Sign of m·(p - center): positive strictly in front of the light's plane. Everything is in front of a
/// distant light.
Sign side_of_light_plane(const Vec3& p, const CircularLight& light);

/// Where the line through a and b meets the light's plane relative to the disk: positive when it misses the
/// closed disk, zero when it touches the rim, negative when it meets the open disk. A line parallel to the
/// plane but not in it misses; a line in the plane is judged by its distance from the center. A line meets a
/// distant disk where its direction, one way or the other, is one to a point of it. a ≠ b. Laws: symmetric in
/// a and b; invariant under scaling by powers of two.
Sign line_outside_disk(const Vec3& a, const Vec3& b, const CircularLight& light);

/// The two planes through an edge's line a → b that touch the disk; they exist iff line_outside_disk ≥ 0.
///
/// kFirst is the plane whose contact point p gives orient3d(a, b, p, center) > 0, kSecond the one that gives
/// < 0. In other words: looked at so that a → b points at the viewer, the disk is an ellipse beside the
/// edge's point, kFirst is its clockwise bound, kSecond the counter-clockwise one. The disk lies where
/// orient3d(a, b, p, ·) ≥ 0 for kFirst, ≤ 0 for kSecond. Swapping a and b swaps the planes. Two cases in
/// which both planes contain the whole disk are read as limits: at radius 0 (radius → 0+), and for an edge in
/// the light's plane, outside of the disk (edge moved a hair to the front). The disk is then on both sides,
/// the two planes face opposite ways, and orient3d(a, b, q, center) > 0 still means "beyond kFirst, inside
/// kSecond". For a distant light read "p" and "center" as points at infinity: orient3d(a, b, ·, center) is
/// the sign of det(b - a, · , -m).
enum class Tangent : std::uint8_t { kFirst, kSecond };

/// Side of q relative to a tangent plane of the disk through the line ab: positive when q and the disk lie on
/// the same side, negative when the plane separates them, zero when q is on it. Decided without roots, as the
/// disk class of (a, b, q) plus orientation signs. Requires line_outside_disk(a, b) > 0. Laws: swapping a and
/// b swaps kFirst and kSecond; a point q beyond one plane and inside the other is one for which
/// classify_face(a, b, q) is not mixed: all-frontfacing ⇔ (negative, positive), none-frontfacing ⇔ (positive,
/// negative).
Sign side_of_tangent_plane(const Vec3& a, const Vec3& b, const Vec3& q, Tangent which,
                           const CircularLight& light);

/// The same for both planes at the price of one: [0] of kFirst, [1] of kSecond.
std::array<Sign, 2> sides_of_tangent_planes(const Vec3& a, const Vec3& b, const Vec3& q,
                                            const CircularLight& light);

}  // namespace penumbra
