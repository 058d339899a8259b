// Whether a face hides one point from another: what rays in float ask where they cannot tell.
#pragma once

#include <cstdint>
#include <optional>

#include "penumbra/mesh/triangle_mesh.h"
#include "render/support/plane_side.h"

namespace penumbra::detail {

// A face hides q from x where its plane separates them and the line through them meets it, its border
// included. It hides nothing where x or q lies in its plane as far as double can tell (side_of_plane).
// Coordinates must neither overflow nor vanish when three of them are multiplied.

/// x and q lie on different sides of the plane. Cost: some 30 ns.
bool separates(const FaceCorners& face, const Vec3& x, const Vec3& q);

/// The line meets the face and does not lie in its plane. On which side of an edge it passes is decided by
/// exact predicates, so that no line slips between two faces at a common edge. Cost: some 50 ns.
bool line_meets(const FaceCorners& face, const Vec3& x, const Vec3& q);

// A ray that grazes a surface by the sine s meets it where float thinks it does but for float's rounding over
// s: on another face, or past a bump that float does not see. Such faces are looked for along the surface.

/// A mesh with its coordinates times a scale.
struct ScaledMesh {
  const TriangleMesh& mesh;
  double scale;
  FaceCorners corners(std::uint32_t face) const;
};

/// Accuracy and speed. How far a surface is followed.
struct WalkLimits {
  double reach;    ///< at most so far beside the segment; in the scaled mesh's units
  int faces = 64;  ///< at most so many each way
  bool forward_only = false;
};

/// The first face that hides q from x of those that follow on a face of a mesh: where the plane through x, q
/// and that face's normal cuts them, both ways, as long as they stay close to the segment. `own`: a face that
/// hides nothing, or none. Cost O(faces followed), some 100 ns each.
std::optional<std::uint32_t> hiding_face_along(const ScaledMesh& mesh, std::uint32_t face, std::int64_t own,
                                               const Vec3& x, const Vec3& q, const WalkLimits& limits);

}  // namespace penumbra::detail
