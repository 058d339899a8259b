// Build: a half-edge triangle mesh from positions and triangles. The first step of the pipeline.
//
// In: spans of positions and of triangles (of polygons, see polygon_soup.h). Out: a mesh whose connectivity
// is always a manifold, possibly with boundary, and a report of what had to be done to make it one.
//
// Connectivity is held in OpenMesh (Botsch et al., "OpenMesh: a generic and efficient polygon mesh data
// structure", 2002). OpenMesh accepts neither three faces at an edge nor two that run along it in the same
// direction. No face is lost for that. Where more than two faces meet at an edge they are joined in pairs, so
// that closed surfaces that touch along edges stay closed; what has no partner is cut, and vertices are
// copied, once for each fan of faces around them (the rule is in mesh/topology/manifold_pieces.h). So such an
// edge becomes several edges at the same place. Boundary edges belong to every silhouette band, which is what
// shadows ask of cut edges. A closed surface with a fin stays closed, and so do voxels that touch along an
// edge. But for the numbering, the result does not depend on the order of the faces.
//
// Numbering: vertices keep the order of the input, and copies follow. Faces keep the order of the input.
// Edges are numbered as the faces first name them, components by their lowest face.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "penumbra/mesh/types.h"

namespace penumbra {

/// One undirected edge.
struct Edge {
  VertexId from, to;
  /// `left` runs along the edge from `from` to `to`; there always is one. `right` runs from `to` to `from`;
  /// it is kNone at a boundary.
  FaceId left, right;
  /// The third vertex of either face; right_apex is kNone at a boundary.
  VertexId left_apex, right_apex;

  bool is_boundary() const { return right == kNone<FaceId>; }
};

/// A set of faces that are connected across edges of the built mesh. Their orientation is consistent.
struct Component {
  std::vector<FaceId> faces;
  /// It has no boundary edge.
  bool closed = false;
  /// Scene units³, positive where the surface faces outward. Only meaningful where it is closed.
  double signed_volume = 0.0;
};

/// What `TriangleMesh::build` did. Numbers of triangles are those of the *input*.
struct BuildReport {
  /// Input vertices that were merged into another one of exactly the same position.
  std::size_t welded_vertices = 0;
  /// Of the rest, those that no kept face uses. They are left out.
  std::size_t unused_vertices = 0;
  /// Copies that were added: vertices = input - welded - unused + split.
  std::size_t split_vertices = 0;
  /// Triangles with fewer than three distinct positions. They are left out.
  std::vector<std::uint32_t> degenerate;
  /// Triangles with three distinct positions whose cross product in double is exactly zero. They are kept.
  std::vector<std::uint32_t> zero_area;
  /// Triangles with the same three positions as an earlier one, in either orientation. They are kept.
  std::vector<std::uint32_t> duplicates;
  /// Undirected edges of welded positions with more than two faces.
  std::size_t non_manifold_edges = 0;
  /// Of these, those at which every face was joined to another one. At the rest some faces were cut apart.
  std::size_t joined_edges = 0;
  /// Vertices whose faces form more than one fan. They were split.
  std::size_t non_manifold_vertices = 0;
  /// Edges with exactly two faces, both of which run along them in the same direction.
  std::size_t misoriented_edges = 0;
  /// Closed components of negative volume, which were turned outward, and how many faces they have.
  std::size_t flipped_components = 0;
  std::size_t flipped_faces = 0;
};

struct BuildOptions {
  /// Merge vertices of exactly equal position (+0 equals -0).
  bool weld = true;
  /// Turn closed components of negative signed volume outward, but not those that bound a cavity of another
  /// one (mesh/topology/cavities.h).
  bool flip_inside_out = true;
};

/// A box with sides parallel to the axes. Without points it is empty.
struct Bounds {
  Vec3 low{std::numeric_limits<double>::infinity()}, high{-std::numeric_limits<double>::infinity()};
  bool empty() const { return !(low.x <= high.x); }
  void add(const Vec3& p);
  void add(const Bounds& b);
  Vec3 center() const { return 0.5 * low + 0.5 * high; }
  /// Half the diagonal; 0 when empty.
  double radius() const;
};

/// A mesh that does not change. Copies are cheap: they share its data.
class TriangleMesh {
 public:
  /// Without vertices and faces.
  TriangleMesh();
  /// Throws MeshError for an index out of range, and for a coordinate that is not finite, whether or not a
  /// face uses it. Expected cost O(V + F log k), k faces at a vertex: about 0.6 s for a million faces.
  static TriangleMesh build(std::span<const Vec3> positions, std::span<const IndexedTriangle> triangles,
                            const BuildOptions& options = {});

  std::span<const Vec3> positions() const;
  std::span<const IndexedTriangle> triangles() const;
  std::span<const Edge> edges() const;
  /// Edges of face f, in the order (v0v1, v1v2, v2v0).
  std::span<const std::array<EdgeId, 3>> face_edges() const;
  /// For each kept face the index of the input triangle it came from.
  std::span<const std::uint32_t> source_triangles() const;
  std::span<const Component> components() const;
  const BuildReport& report() const;

  const Vec3& position(VertexId v) const { return positions()[penumbra::index(v)]; }
  /// Of the positions.
  const Bounds& bounds() const;
  /// The length of the longest edge in scene units, rounded; infinite on overflow, 0 without edges.
  double longest_edge() const;
  bool empty() const { return triangles().empty(); }
  /// Every component is closed, and there is at least one face.
  bool is_closed() const;

 private:
  struct Data;
  std::shared_ptr<const Data> data_;
};

Bounds bounds_of(std::span<const Vec3> positions);

}  // namespace penumbra
