// Silhouette method, step merge: one caster's faces merged to patches, and the edges between patches merged
// to longer edges.
//
// In: a mesh, and tolerances that grow. Out: for each tolerance the patches (face_patches.h) and the edges
// between them. Chains of edges between the same two sides are replaced by one edge from end to end, as far
// as the tolerance allows; every chain keeps its ends, so the surface stays as closed as it was.
//
// Where both sides look the same way the edge is no silhouette, and where it runs does not matter. Else what
// lies between chain and edge is taken for the wrong side. Let Q be the surface between them that joins each
// point of the chain to the nearest point of the edge, n the direction halfway between the normals l and r of
// the sides. x sees Q's parts across n in full. It sees parts along the surface at a slant: the mean planes
// of the sides have values of opposite signs at x, so for p near the edge and ν = |l + r|
//   |n·(x - p)| ≤ (|l - r| |x - p| + 2 off) / ν,  off: the distances of p from both planes,
// and off is the thickness of the sides or less: `swept` times the distance, plus `swept_at_any`. Sums over Q
// are of magnitudes, and what a chain strays counts at its largest: nothing cancels, and a tooth in a long
// straight border does not become smaller with it.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
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
  /// The area of Q along the surface, and across it. Sums of magnitudes.
  double along = 0.0, across = 0.0;
  /// The largest distance of a point of the chain from the edge, and the part of it off the surface. Scene
  /// units.
  double stray = 0.0, lift = 0.0;
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
  /// What may be taken for the wrong side between the chain and the edge: MergedEdge::swept, an area, and
  /// MergedEdge::swept_at_any, an area times a length.
  double swept(const EdgeChain& chain) const;
  double swept_at_any(const EdgeChain& chain) const;
  /// How far beside an edge what it stands for may be seen (MergedEdge::margin). Scene units.
  double margin(const EdgeChain& chain) const;
  /// Merges faces, then chains of edges. The tolerance is larger than before; scene units. Cost O(F).
  void merge(double tolerance);

 private:
  std::size_t faces() const { return mesh_.triangles().size(); }
  const Vec3& position(std::uint32_t vertex) const { return mesh_.positions()[vertex]; }
  double error_of(std::uint32_t side) const;
  double thick_of(std::uint32_t side) const;
  double radius_of(std::uint32_t side) const;
  Vec3 normal_of(std::uint32_t side) const;
  Vec3 middle_of(std::uint32_t left, std::uint32_t right) const;
  /// How much of what lies along the surface a receiver sees where the edge is a silhouette: no more than
  /// `tilted` times its distance, plus `thick`, a length.
  struct Slant {
    double tilted, thick;
  };
  Slant slant(const EdgeChain& chain) const;
  /// How far a silhouette is displaced by leaving the chain, for a receiver at the distance of the sides'
  /// radius.
  double left_by(const EdgeChain& chain) const;
  void join(const std::vector<EdgeChain>& edges, double tolerance);
  EdgeChain joined(std::span<const EdgeChain* const> way) const;
  void straighten(std::span<const EdgeChain* const> way, double tolerance);

  const TriangleMesh& mesh_;
  std::optional<FacePatches> tree_;
  std::vector<FacePatch> patches_;
  std::vector<EdgeChain> chains_;
};

}  // namespace penumbra::detail
