// Step 0 of the pipeline: a half-edge triangle mesh.
//
// In: spans of positions and of triangles (or polygons, see polygon_soup.h). Out: a mesh whose connectivity
// is always a manifold (possibly with boundary), and a report of what had to be done to make it one.
//
// Connectivity is held in OpenMesh (Botsch et al., "OpenMesh: a generic and efficient polygon mesh data
// structure", 2002), which accepts neither three faces at an edge nor two that run along it in the same
// direction. No face is lost for that: such an edge is cut and its vertices are copied, one copy for each fan
// of faces around them (the rule is in detail/manifold_pieces.h), so that it becomes several boundary edges
// at the same place. Boundary edges belong to every silhouette band, which is what shadows ask of such edges.
// Only where both sides of a cut end at the same two copies are they joined again: a closed surface with a
// fin, or two that touch along an edge, stay closed. The result does not depend on the order of the faces but
// for the numbering.
//
// Numbering: vertices keep the input's order and copies follow; faces keep the input's order; edges are
// numbered as the faces first name them; components by their lowest face.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "penumbra/mesh/types.h"

namespace penumbra {

/// One undirected edge. Face `left`, which there always is, runs from → to; `right` (kNone at a boundary) to
/// → from.
struct Edge {
  VertexId from, to;
  FaceId left, right;
  VertexId left_apex, right_apex;  ///< the face's third vertex; right_apex is kNone at a boundary
  bool is_boundary() const { return right == kNone<FaceId>; }
};

/// A connected set of faces (joined across edges of the built mesh).
struct Component {
  std::vector<FaceId> faces;
  bool closed = false;         ///< no boundary edge; orientation is consistent in any case
  double signed_volume = 0.0;  ///< scene units³; positive: outward; meaningful where closed
};

/// What `TriangleMesh::build` did. Ids refer to the *input* triangles unless said otherwise.
struct BuildReport {
  std::size_t welded_vertices = 0;        ///< input vertices merged into another of exactly the same position
  std::size_t unused_vertices = 0;        ///< of the rest, those that no kept face uses (left out)
  std::size_t split_vertices = 0;         ///< copies added; vertices = input - welded - unused + split
  std::vector<std::uint32_t> degenerate;  ///< triangles left out: fewer than three distinct positions
  /// Kept: three distinct but collinear positions, as far as double can tell: cross product exactly zero.
  std::vector<std::uint32_t> zero_area;
  /// Kept: same three positions as an earlier triangle, in either orientation.
  std::vector<std::uint32_t> duplicates;
  std::size_t non_manifold_edges = 0;     ///< undirected edges (of welded positions) with more than two faces
  std::size_t non_manifold_vertices = 0;  ///< vertices whose faces form more than one fan (split)
  std::size_t misoriented_edges = 0;      ///< edges with exactly two faces that run the same way along them
  std::size_t flipped_components = 0;     ///< closed components of negative volume, turned outward
  std::size_t flipped_faces = 0;          ///< how many faces that were
};

struct BuildOptions {
  bool weld = true;             ///< merge vertices of exactly equal position (+0 equals -0)
  bool flip_inside_out = true;  ///< turn closed components of negative signed volume outward, cavities too
};

struct Bounds {
  Vec3 low{std::numeric_limits<double>::infinity()}, high{-std::numeric_limits<double>::infinity()};
  bool empty() const { return !(low.x <= high.x); }
  void add(const Vec3& p);
  void add(const Bounds& b);
  Vec3 center() const { return 0.5 * low + 0.5 * high; }
  double radius() const;  ///< half the diagonal; 0 when empty
};

class TriangleMesh {
 public:
  TriangleMesh();  ///< empty
  /// Builds the mesh. Throws MeshError for an index out of range or a coordinate that is not finite, in a
  /// vertex that is used or not. Expected cost O(V + F log k), k faces at a vertex: about 0.6 s for a
  /// million.
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
  const Bounds& bounds() const;  ///< of the positions
  double longest_edge() const;   ///< its length in scene units, rounded (infinite on overflow); 0: no edge
  bool empty() const { return triangles().empty(); }
  bool is_closed() const;  ///< every component closed, and at least one face

 private:
  struct Data;
  std::shared_ptr<const Data> data_;  ///< immutable: copies are cheap and share it
};

Bounds bounds_of(std::span<const Vec3> positions);

}  // namespace penumbra
