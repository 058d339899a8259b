// Silhouette method, step merge: one caster's faces merged to patches, and the edges between patches merged
// to longer edges.
//
// In: a mesh, and tolerances that grow. Out: for each tolerance the patches (face_patches.h) and the edges
// between them. Chains of edges between the same two sides are replaced by one edge from end to end, as far
// as the tolerance allows; every chain keeps its ends, so the surface stays as closed as it was.
//
// A merged edge displaces the silhouette because its sides are patches (FacePatch::error), and because it
// leaves the chain. Let S be the area between chain and edge. Where the sides look almost the same way the
// chain is seen edge-on: of S the part across the surface counts, and of the part along it as much as the
// normals of the sides differ. That over the length of the edge is how far it displaces the silhouette.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "penumbra/mesh/triangle_mesh.h"
#include "render/silhouette/merge/face_patches.h"

namespace penumbra::detail {

/// An edge between two sides, on its way from one tolerance to the next.
struct EdgeChain {
  /// Vertices.
  std::uint32_t from, to;
  /// As in FacePatches::Partition::side; MergedEdge::kNoSide without a right one.
  std::uint32_t left, right;
  /// The area between the chain and the edge from end to end, as a vector.
  Vec3 swept{0.0};
  /// The largest distance of a vertex that was left out from the edge. Scene units.
  double stray = 0.0;
};

/// Refers to the mesh. A mesh of few faces keeps its faces and edges as they are.
class CasterMerger {
 public:
  /// Speed. The least number of faces of a mesh that is merged; smaller ones gain nothing. Seen in the
  /// benchmark `growth`.
  static constexpr std::size_t kFewestFaces = 1024;

  explicit CasterMerger(const TriangleMesh& mesh);

  const std::vector<EdgeChain>& chains() const { return chains_; }
  const std::vector<FacePatch>& patches() const { return patches_; }
  /// About how many faces and patches there are at a tolerance. Cost O(as many).
  std::size_t count_parts(double tolerance) const;
  /// How far an edge may displace a silhouette (MergedEdge::deviation). Scene units.
  double deviation(const EdgeChain& chain) const;
  /// How far beside an edge what it stands for may be seen (MergedEdge::margin). Scene units.
  double margin(const EdgeChain& chain) const;
  /// Merges faces, then chains of edges. The tolerance is larger than before; scene units. Cost O(F).
  void merge(double tolerance);

 private:
  std::size_t faces() const { return mesh_.triangles().size(); }
  const Vec3& position(std::uint32_t vertex) const { return mesh_.positions()[vertex]; }
  double error_of(std::uint32_t side) const;
  Vec3 normal_of(std::uint32_t side) const;
  double distance_from(std::uint32_t vertex, const EdgeChain& edge) const;
  double swept_width(std::uint32_t left, std::uint32_t right, const Vec3& swept, std::uint32_t from,
                     std::uint32_t to) const;
  void join(const std::vector<EdgeChain>& edges, double tolerance);
  void straighten(const std::vector<const EdgeChain*>& way, double tolerance);

  const TriangleMesh& mesh_;
  std::optional<FacePatches> tree_;
  std::vector<FacePatch> patches_;
  std::vector<EdgeChain> chains_;
};

}  // namespace penumbra::detail
