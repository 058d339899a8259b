// On which side of a face's plane a point lies, as far as double can tell.
#pragma once

#include "penumbra/mesh/types.h"

namespace penumbra::detail {

struct FaceCorners {
  Vec3 a, b, c;
};

/// Positive on the side from which a, b, c run counter-clockwise, negative on the other. 0 where double
/// cannot tell p from a point of the plane, and for a face without area.
///
/// The side is the sign of D = N·(p - a) with N = (b - a) × (c - a), which is minus the determinant of A = a
/// - p, B = b - p and C = c - p. Surface points are rounded: one that was computed from a plane and put back
/// onto it once misses it by five roundings of its coordinates at most (camera_rays.cpp), and coordinates
/// themselves are rounded to begin with. To first order, D changes by
///   6u · (|B × C|·|a| + |C × A|·|b| + |A × B|·|c| + |N|·|p|),   u = 2^-53,
/// absolute values by component, where each of the twelve coordinates moves by six roundings. The rounding of
/// D itself is added to that.
int side_of_plane(const FaceCorners& face, const Vec3& p);

}  // namespace penumbra::detail
