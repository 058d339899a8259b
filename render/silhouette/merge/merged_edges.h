// Levels of merged edges: what is left of a fine mesh's edges where patches of faces are taken for one.
//
// In: casters, once. Out: for tolerances that double from level to level, the edges between patches
// (face_patches.h), with chains of edges between the same two patches replaced by one from end to end. The
// surface stays as closed as it was, since every chain keeps its ends. A level moves the silhouette that x
// sees at p by at most `deviation` · |x - p| · (what x sees at p is magnified by), not counting where it moves
// within the surface: a chain between patches that look almost the same way is seen edge-on, so that of the
// area S between chain and edge only the part across the surface counts, and of that along it as much as the
// patches' normals differ.
//
// Casters of few faces and faces that no patch holds stay as they are, with nothing moved.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <span>
#include <vector>

#include "penumbra/render/scene/scene.h"
#include "render/silhouette/edges/bounds_tree.h"
#include "render/silhouette/merge/face_patches.h"

namespace penumbra::detail {

struct MergedEdge {
  static constexpr std::uint32_t kNoSide = 0xffffffffu;
  std::uint32_t object;       ///< index in the scene
  VertexId from, to;          ///< of its mesh
  std::uint32_t left, right;  ///< as in FacePatches::Cut::side; kNoSide without a right one
  float deviation = 0.0f;     ///< see above; scene units
  float margin = 0.0f;        ///< what it stands for is seen at most that far beside it; scene units
};

/// What the two sides of an edge stand for, in some frame. Where x sees a patch from both sides it sees it
/// edge-on: it lies in a slab that is `thick` either way, x is no farther from the middle of that than its
/// faces' planes differ there, and so the patch is a strip whose outline runs all along it. With x twice the
/// patch's radius away the strip is seen as wide as 2 (thick + spread + radius · tilt) would be at the patch.
/// So nothing of it is seen farther from its outline than that, nor farther from the edges in place of its
/// outline than that and what they were straightened by: `margin`.
struct MergedSides {
  struct Side {
    Vec3 center{0.0};
    double radius = 0.0;              ///< of a ball around the faces; 0 where one face is alone
    double tilt = 0.0, spread = 0.0;  ///< planes differ by tilt · distance from the center + spread at most
    bool is_flat = true;              ///< but for rounding (FacePatch)
    double reach(const Vec3& x) const {  // the sum of components is no less than the distance, and cheaper
      return tilt * (std::abs(x.x - center.x) + std::abs(x.y - center.y) + std::abs(x.z - center.z)) + spread;
    }
    bool is_far(const Vec3& x) const { return glm::distance(x, center) >= 2.0 * radius; }
  };
  Side left, right;
  double margin = 0.0;
  Vec3 middle{0.0}, half{0.0};  ///< of a box around the edge, with its margin, and the faces of curved sides
};

/// Eight edges that lie close together, in some frame.
struct MergedBlock {
  static constexpr std::size_t kEdges = BoundsTree::kFanOut;
  std::size_t count = 0;
  std::array<BandEdge, kEdges> edges;
  std::array<MergedSides, kEdges> sides;
  float deviation = 0.0f;  ///< the largest; scene units
  /// Each edge's box.
  void make_boxes();
  /// Of the edges and of all faces that they stand for; requires boxes.
  BlockBounds bounds() const;
};

struct MergedLevel {
  std::vector<MergedEdge> edges;                ///< neighbors lie close together
  std::vector<std::vector<FacePatch>> patches;  ///< of each object
  BoundsTree tree;                              ///< over the blocks, in the frame of rays
  double deviation = 0.0;                       ///< of those edges that are moved the mean; scene units

  /// Block i in a frame with point(p), direction(d) and per_unit(), with coordinates up to `extent`.
  template <class Frame>
  MergedBlock block(const Scene& scene, std::size_t i, const Frame& frame, double extent) const;
  std::size_t block_count() const { return (edges.size() + MergedBlock::kEdges - 1) / MergedBlock::kEdges; }
  std::size_t bytes() const;

 private:
  template <class Frame>
  FacePlane side(const Scene& scene, const MergedEdge& e, std::uint32_t side, const Frame& frame,
                 double extent, MergedSides::Side& out) const;
};

class MergedEdges {
 public:
  /// In the frame (p - origin) · scale. Cost O(F log F) in the faces of large casters, on all cores.
  MergedEdges(const Scene& scene, const Vec3& origin, double scale);
  /// Coarsest last; none where merging does not pay.
  const std::vector<MergedLevel>& levels() const { return levels_; }
  /// Blocks of a level with faces of which the light may see both sides, ascending; without those of objects
  /// whose flag in `cannot_occlude` (one an object, or none) is set.
  std::vector<std::uint32_t> blocks_of(const MergedLevel& level, const DiskLight& light,
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
