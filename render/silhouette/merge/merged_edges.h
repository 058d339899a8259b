// Silhouette method, step merge: levels of detail of a scene's edges, for casters finer than a silhouette
// can tell.
//
// In: the casters, once. Out: for tolerances that double from level to level, the edges between patches of
// faces (face_patches.h), with chains of edges between the same two patches merged to one
// (caster_merger.h). The surface stays as closed as it was, since every chain keeps its ends.
//
// What is bounded: a receiver x sees the silhouette at p displaced by at most
//   deviation · |x - p| · (how much x sees p magnified),
// not counting displacements within the surface. Casters of few faces and faces that no patch holds stay as
// they are, with a deviation of 0.
#pragma once

#include <algorithm>
#include <cstdint>
#include <glm/geometric.hpp>
#include <span>
#include <vector>

#include "penumbra/render/scene/scene.h"
#include "render/silhouette/edges/bounds_tree.h"
#include "render/silhouette/merge/face_patches.h"
#include "render/silhouette/merge/merged_block.h"

namespace penumbra::detail {

/// One level of detail.
struct MergedLevel {
  /// Neighbors lie close together, eight a block.
  std::vector<MergedEdge> edges;
  /// One list an object.
  std::vector<std::vector<FacePatch>> patches;
  /// Over the blocks, in the frame of rays.
  BoundsTree tree;
  /// The mean over those edges of which it is not 0. Scene units.
  double deviation = 0.0;

  /// Block i in some frame. `frame` has point(p) and direction(d), which take a point and a vector of the
  /// world there, and per_unit(), its units in one scene unit. `extent`: the largest coordinate there.
  template <class Frame>
  MergedBlock block(const Scene& scene, std::size_t i, const Frame& frame, double extent) const;
  std::size_t block_count() const { return (edges.size() + MergedBlock::kEdges - 1) / MergedBlock::kEdges; }
  std::size_t bytes() const;

 private:
  /// The plane of one side of an edge, and into `out` what the side stands for.
  template <class Frame>
  FacePlane side(const Scene& scene, const MergedEdge& e, std::uint32_t side, const Frame& frame,
                 double extent, MergedSides::Side& out) const;
};

class MergedEdges {
 public:
  /// The trees are in the frame (p - origin) · scale. Cost O(F log F) for the faces F of large casters, on
  /// all cores.
  MergedEdges(const Scene& scene, const Vec3& origin, double scale);
  /// The coarsest last. None where merging does not pay.
  const std::vector<MergedLevel>& levels() const { return levels_; }
  /// The blocks of a level that may hold an edge of the light's band, ascending. `cannot_occlude`: a flag
  /// an object, or none at all; blocks with edges only of objects whose flag is set are left out.
  std::vector<std::uint32_t> blocks_of(const MergedLevel& level, const CircularLight& light,
                                       std::span<const char> cannot_occlude) const;
  std::size_t bytes() const;

 private:
  Vec3 origin_;
  double scale_;
  std::vector<MergedLevel> levels_;
};

template <class Frame>
FacePlane MergedLevel::side(const Scene& scene, const MergedEdge& e, std::uint32_t side, const Frame& frame,
                            double extent, MergedSides::Side& out) const {
  if (side == MergedEdge::kNoSide) return kNoFace;
  const TriangleMesh& mesh = scene.objects[e.object].mesh;
  const std::size_t faces = mesh.triangles().size();
  if (side < faces)
    return MeshArrays(mesh).plane(
        FaceId{side}, [&](const Vec3& p) { return frame.point(p); }, extent);
  const FacePatch& patch = patches[e.object][side - faces];
  const Vec3 normal = frame.direction(patch.normal);
  out = {frame.point(patch.center), patch.radius * frame.per_unit(), patch.tilt,
         patch.spread * frame.per_unit(), patch.is_flat()};
  return {normal, -glm::dot(normal, out.center), 0x1p-44 * extent};
}

template <class Frame>
MergedBlock MergedLevel::block(const Scene& scene, std::size_t i, const Frame& frame, double extent) const {
  MergedBlock out;
  out.count = std::min(MergedBlock::kEdges, edges.size() - i * MergedBlock::kEdges);
  for (std::size_t k = 0; k < out.count; ++k) {
    const MergedEdge& e = edges[i * MergedBlock::kEdges + k];
    const TriangleMesh& mesh = scene.objects[e.object].mesh;
    out.edges[k] = {frame.point(mesh.position(e.from)), frame.point(mesh.position(e.to)),
                    side(scene, e, e.left, frame, extent, out.sides[k].left),
                    side(scene, e, e.right, frame, extent, out.sides[k].right)};
    out.sides[k].margin = e.margin * frame.per_unit();
    out.deviation = std::max(out.deviation, e.deviation);
  }
  out.make_boxes();
  return out;
}

}  // namespace penumbra::detail
