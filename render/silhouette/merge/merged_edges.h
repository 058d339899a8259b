// Silhouette method, step merge: levels of detail of a scene's edges, for casters finer than a silhouette
// can tell.
//
// In: the casters, once. Out: for tolerances that double from level to level, the edges between patches of
// faces (face_patches.h), with chains of edges between the same two patches merged to one
// (caster_merger.h). The surface stays as closed as it was, since every chain keeps its ends.
//
// What is bounded: the part of the light's plane at which the number of faces before it is not what merged
// edges make of it. For x at the height H over that plane its area is
//   Σ H²/w³ · (what the sides and chains of edges may have taken for the wrong side, MergedFaults)
// or less, w how far they lie below x. The sum is over all patches that x sees from both sides, and over the
// chains of edges that are silhouettes. Casters of few faces and faces that no patch holds stay as they are,
// with nothing mistaken.
#pragma once

#include <algorithm>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
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
  /// One number an object: how many faces its mesh has. Sides of larger numbers are patches.
  std::vector<std::uint32_t> faces;
  /// Over the blocks, in the frame of rays.
  BoundsTree tree;
  /// MergedEdge::deviation, the mean over those edges of which it is not 0. Scene units.
  double deviation = 0.0;

  /// How many edges of some blocks each patch has: one list an object, as `patches`.
  using EdgeCounts = std::vector<std::vector<std::uint32_t>>;
  EdgeCounts count_edges(std::span<const std::uint32_t> blocks) const;

  /// Block i in some frame. `frame` has point(p) and direction(d), which take a point and a vector of the
  /// world there, and per_unit(), its units in one scene unit. `extent`: the largest coordinate there.
  /// `counts`: of all blocks that are asked for; what a patch may have mistaken is divided among these edges.
  template <class Frame>
  MergedBlock block(const Scene& scene, std::size_t i, const Frame& frame, double extent,
                    const EdgeCounts& counts) const;
  std::size_t block_count() const { return (edges.size() + MergedBlock::kEdges - 1) / MergedBlock::kEdges; }
  std::size_t bytes() const;

 private:
  /// The plane of one side of an edge, and what the side stands for.
  template <class Frame>
  FacePlane side(const Scene& scene, const MergedEdge& e, std::uint32_t side, const Frame& frame,
                 double extent, const EdgeCounts& counts, MergedSides::Side& sides,
                 MergedFaults::Side& faults) const;
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

/// A symmetric matrix in another frame.
template <class Frame>
glm::dmat3 turned_to(const Frame& frame, const glm::dmat3& m) {
  const auto columns = [&](const glm::dmat3& of) {
    return glm::dmat3(frame.direction(of[0]), frame.direction(of[1]), frame.direction(of[2]));
  };
  return columns(glm::transpose(columns(m)));
}

template <class Frame>
FacePlane MergedLevel::side(const Scene& scene, const MergedEdge& e, std::uint32_t side, const Frame& frame,
                            double extent, const EdgeCounts& counts, MergedSides::Side& sides,
                            MergedFaults::Side& faults) const {
  if (side == MergedEdge::kNoSide) return kNoFace;
  const std::uint32_t first = faces[e.object];
  if (side < first)
    return MeshArrays(scene.objects[e.object].mesh)
        .plane(
            FaceId{side}, [&](const Vec3& p) { return frame.point(p); }, extent);
  const FacePatch& patch = patches[e.object][side - first];
  const Vec3 normal = frame.direction(patch.normal);
  // The mean plane counts as holding x where those of all faces do: there, and only if they are all the same
  // plane.
  const double grain = kPlaneGrain * extent, unit = frame.per_unit();
  const bool is_flat = patch.is_flat() && 4.0 * patch.thick * unit <= grain;
  sides = {frame.point(patch.center), patch.radius * unit, patch.tilt, patch.spread * unit, is_flat};
  const FacePlane plane{normal, -glm::dot(normal, sides.center), is_flat ? grain : 0.0};
  if (is_flat) return plane;
  // A value is off by the grain or less. As much is added to how far the faces are shifted.
  const double area = unit * unit / counts[e.object][side - first];
  faults = {area * patch.area, area * (unit * patch.shifted + grain * patch.area),
            area * area * turned_to(frame, patch.turned)};
  return plane;
}

template <class Frame>
MergedBlock MergedLevel::block(const Scene& scene, std::size_t i, const Frame& frame, double extent,
                               const EdgeCounts& counts) const {
  MergedBlock out;
  out.count = std::min(MergedBlock::kEdges, edges.size() - i * MergedBlock::kEdges);
  for (std::size_t k = 0; k < out.count; ++k) {
    const MergedEdge& e = edges[i * MergedBlock::kEdges + k];
    const TriangleMesh& mesh = scene.objects[e.object].mesh;
    MergedSides& sides = out.sides[k];
    MergedFaults& faults = out.faults[k];
    out.edges[k] = {frame.point(mesh.position(e.from)), frame.point(mesh.position(e.to)),
                    side(scene, e, e.left, frame, extent, counts, sides.left, faults.left),
                    side(scene, e, e.right, frame, extent, counts, sides.right, faults.right)};
    sides.margin = e.margin * frame.per_unit();
    faults.stray = e.stray * frame.per_unit();
    faults.swept = e.swept * frame.per_unit() * frame.per_unit();
    faults.swept_at_any = e.swept_at_any * frame.per_unit() * frame.per_unit() * frame.per_unit();
  }
  out.make_boxes();
  return out;
}

}  // namespace penumbra::detail
