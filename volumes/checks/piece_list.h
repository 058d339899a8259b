// The connected pieces of a shadow volume, each convex: what is inside, and points to try.
#pragma once

#include <random>

#include "penumbra/mesh/triangle_mesh.h"
#include "penumbra/volumes/shadow_mesh.h"

namespace penumbra::detail {

/// For each part that is connected by indices, its triangles. Parts are in the order of their first
/// triangles.
std::vector<std::vector<std::uint32_t>> connected_pieces(std::size_t vertex_count,
                                                         std::span<const IndexedTriangle> triangles);

/// The pieces of a mesh, taken to be convex, as those of umbra and penumbra volumes are. Keeps a reference to
/// the mesh.
class PieceList {
 public:
  explicit PieceList(const ShadowMesh& mesh);

  /// Whether x is, for some piece, beyond none of its triangles; decided exactly. Cost O(pieces + triangles
  /// of those whose box holds x).
  bool contains(const Vec3& x) const;
  /// An average of some corners of a piece, moved inward a little so that rounding does not take it outside.
  /// The mesh must not be empty.
  Vec3 point_inside(std::mt19937_64& random) const;

 private:
  struct Piece {
    std::vector<std::uint32_t> triangles;
    Bounds box;
    Vec3 middle{0.0};
  };
  bool is_beyond(const Vec3& x, std::uint32_t triangle) const;

  const ShadowMesh& mesh_;
  std::vector<Piece> pieces_;
};

}  // namespace penumbra::detail
