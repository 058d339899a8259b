// An edge of a caster between the planes of its faces.
//
// An edge a → b seen from x is a line across the disk. The number of faces that hide a point of the disk
// jumps there by `jump_at`, faces on its left minus faces on its right, and on which side a face lies is the
// sign of its plane at x. That is true whether meshes are closed, open, not manifold or inconsistently wound;
// edges that are no silhouette from x have a jump of 0.
#pragma once

#include <array>
#include <glm/geometric.hpp>
#include <limits>
#include <span>

#include "penumbra/mesh/triangle_mesh.h"

namespace penumbra::detail {

/// The plane of a face: value(x) = normal·x + offset is x's distance, positive where the face
/// is seen counter-clockwise. Beyond ±tolerance the sign is that of the exact value for the vertices as
/// given: with coordinates up to M, each off by a few u M (u = 2^-53), N = E1 × E2 is off by a few u M (|E1|
/// + |E2|), and that times a distance of at most 4M, over |N|, is what the tolerance bounds (with u = 2^-46).
/// A face without area has normal 0, and no sign of it is certain.
struct FacePlane {
  Vec3 normal;
  double offset, tolerance;
  double value(const Vec3& x) const { return normal.x * x.x + normal.y * x.y + normal.z * x.z + offset; }
};

/// In place of a face that is missing: surely on neither side.
inline const FacePlane kNoFace{Vec3(0.0), 0.0, -1.0};

/// Two lines of the processor's cache, the ends in the first. (Nothing is initialized by itself: a band's
/// memory is first touched by whoever fills it.)
struct alignas(64) BandEdge {
  Vec3 a, b;              ///< in a band: z ≥ 0
  FacePlane left, right;  ///< of the faces that run a → b and b → a; kNoFace without a right one
  bool has_right() const { return right.tolerance >= 0.0; }
};
static_assert(sizeof(BandEdge) == 128);

/// Faces on the left minus faces on the right of a → b, as seen from x.
inline int jump_at(const BandEdge& e, const Vec3& x) {
  return (e.left.value(x) > 0.0 ? 1 : -1) + (e.has_right() ? (e.right.value(x) > 0.0 ? -1 : 1) : 0);
}

/// Of a face with these corners in a frame with coordinates up to `extent`.
inline FacePlane face_plane(const Vec3& a, const Vec3& b, const Vec3& c, double extent) {
  const Vec3 e1 = b - a, e2 = c - a, normal = glm::cross(e1, e2);
  const double length = glm::length(normal);
  if (!(length > 0.0)) return {Vec3(0.0), 0.0, std::numeric_limits<double>::infinity()};
  const Vec3 n = normal / length;
  const double spread = (glm::length(e1) + glm::length(e2)) / length;
  return {n, -glm::dot(n, a), 0x1p-46 * extent * (1.0 + 4.0 * extent * spread)};
}

/// A mesh's arrays.
struct MeshArrays {
  explicit MeshArrays(const TriangleMesh& mesh)
      : positions(mesh.positions()), triangles(mesh.triangles()), edges(mesh.edges()) {}
  std::span<const Vec3> positions;
  std::span<const IndexedTriangle> triangles;
  std::span<const Edge> edges;

  /// `to_frame` takes positions to the frame.
  template <class ToFrame>
  std::array<Vec3, 3> corners(FaceId face, const ToFrame& to_frame) const {
    const IndexedTriangle& t = triangles[index(face)];
    return {to_frame(positions[t[0]]), to_frame(positions[t[1]]), to_frame(positions[t[2]])};
  }
  template <class ToFrame>
  FacePlane plane(FaceId face, const ToFrame& to_frame, double extent) const {
    const auto [a, b, c] = corners(face, to_frame);
    return face_plane(a, b, c, extent);
  }
  template <class ToFrame>
  BandEdge edge(EdgeId id, const ToFrame& to_frame, double extent) const {
    const Edge& e = edges[index(id)];
    return {to_frame(positions[index(e.from)]), to_frame(positions[index(e.to)]),
            plane(e.left, to_frame, extent), e.is_boundary() ? kNoFace : plane(e.right, to_frame, extent)};
  }
};

}  // namespace penumbra::detail
