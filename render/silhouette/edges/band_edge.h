// Silhouette method, step edges: an edge of a caster, with the planes of its faces.
//
// An edge a → b, seen from x, is a line across the disk. The number of faces that hide a point of the disk
// jumps at that line: by the faces on the edge's left minus the faces on its right (`jump_at`). On which side
// a face lies is the sign of its plane's value at x; a face in whose plane x lies, as far as double can tell,
// hides nothing and counts on neither side. This holds for meshes that are closed, open, not manifold or
// wound inconsistently. An edge that is no silhouette from x has a jump of 0.
#pragma once

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <span>

#include "penumbra/mesh/triangle_mesh.h"

namespace penumbra::detail {

/// The plane of a face. value(x) = normal·x + offset is the distance of x from it, positive where the face is
/// seen counter-clockwise.
///
/// A value beyond ±tolerance has the sign of the exact value for the vertices as given. Let M be the
/// largest coordinate, u = 2^-53, E1 and E2 two sides of the face, N = E1 × E2. Coordinates are off by a
/// few u M, so N is off by a few u M (|E1| + |E2|). The tolerance bounds that, times a distance of at most
/// 4 M, over |N|, with 2^-46 in place of u.
///
/// A face without area has normal 0 and an infinite tolerance: no sign of it is certain.
struct FacePlane {
  Vec3 normal;
  double offset, tolerance;
  double value(const Vec3& x) const { return normal.x * x.x + normal.y * x.y + normal.z * x.z + offset; }
};

/// Stands for the right face of a boundary edge: on neither side.
inline const FacePlane kNoFace{Vec3(0.0), 0.0, -1.0};

/// Two cache lines; the ends are in the first. Members have no initializers, so that the memory of a band is
/// touched first by the thread that fills it.
struct alignas(64) BandEdge {
  /// In a band z ≥ 0.
  Vec3 a, b;
  /// Of the faces that run a → b and b → a. `right` is kNoFace for a boundary edge.
  FacePlane left, right;
  bool has_right() const { return right.tolerance >= 0.0; }
};
static_assert(sizeof(BandEdge) == 128);

/// What rounding leaves open, in a frame.
struct Rounding {
  /// The certificate's margin at the disk, light radii (certificate_slack).
  double slack;
  /// The largest coordinate, M above; 0 where nothing but its own tolerance is to be used of a plane.
  double extent = 0.0;
};

/// Accuracy. The tolerance of a plane that is known as well as coordinates are, over the largest coordinate.
/// Faces have larger ones.
inline constexpr double kPlaneGrain = 0x1p-46;

/// The side of a face on which x lies: 1 where the face is seen counter-clockwise, -1, or 0 where its plane
/// contains x as far as double can tell. `a`: a corner of the face.
///
/// The plane's tolerance holds for all points up to 4 M away. Of a point at distance d from the corner, n·(x
/// - a) is off by d/(4 M) of it, and by a rounding of coordinates. That is not so for the mean plane of
/// merged faces, which need not hold the corner: its tolerance is kPlaneGrain M or less. Where that is 0,
/// every point lies on some side of it.
inline int side_of(const FacePlane& plane, const Vec3& a, const Vec3& x, double extent) {
  double value = plane.value(x), tolerance = plane.tolerance;
  if (tolerance == 0.0) return value > 0.0 ? 1 : -1;
  const double grain = kPlaneGrain * extent;
  if (!(std::abs(value) > tolerance) && extent > 0.0 && tolerance > grain) {
    value = glm::dot(plane.normal, x - a);
    tolerance = grain + (tolerance - grain) * glm::distance(x, a) / (4.0 * extent);
  }
  return std::abs(value) > tolerance ? (value > 0.0 ? 1 : -1) : 0;
}

/// Faces on the left minus faces on the right of a → b, seen from x: -2 to 2. `extent` as in Rounding.
inline int jump_at(const BandEdge& e, const Vec3& x, double extent = 0.0) {
  return side_of(e.left, e.a, x, extent) - (e.has_right() ? side_of(e.right, e.a, x, extent) : 0);
}

/// The plane of a face with these corners. `extent`: the largest coordinate in the frame, M above.
inline FacePlane face_plane(const Vec3& a, const Vec3& b, const Vec3& c, double extent) {
  const Vec3 e1 = b - a, e2 = c - a, normal = glm::cross(e1, e2);
  const double length = glm::length(normal);
  if (!(length > 0.0)) return {Vec3(0.0), 0.0, std::numeric_limits<double>::infinity()};
  const Vec3 n = normal / length;
  const double spread = (glm::length(e1) + glm::length(e2)) / length;
  return {n, -glm::dot(n, a), kPlaneGrain * extent * (1.0 + 4.0 * extent * spread)};
}

/// A mesh's arrays, and its faces and edges in some frame. `to_frame` takes a position to that frame;
/// `extent` is the largest coordinate there. Refers to the mesh.
struct MeshArrays {
  explicit MeshArrays(const TriangleMesh& mesh)
      : positions(mesh.positions()), triangles(mesh.triangles()), edges(mesh.edges()) {}
  std::span<const Vec3> positions;
  std::span<const IndexedTriangle> triangles;
  std::span<const Edge> edges;

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
