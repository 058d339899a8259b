// Silhouette method, step merge: merged edges, what their sides stand for, and blocks of eight of them in
// some frame.
//
// A merged edge stands for a chain of edges between two patches of faces (caster_merger.h). Its sides are
// patches, or single faces. What a receiver sees of a chain and of its patches lies near the merged edge;
// `MergedSides` says how near.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include "penumbra/mesh/triangle_mesh.h"
#include "render/silhouette/edges/bounds_tree.h"

namespace penumbra::detail {

struct MergedEdge {
  static constexpr std::uint32_t kNoSide = 0xffffffffu;
  /// Index in the scene.
  std::uint32_t object;
  /// Vertices of its mesh.
  VertexId from, to;
  /// The sides, as in FacePatches::Partition::side; `right` is kNoSide for a boundary.
  std::uint32_t left, right;
  /// How far it displaces silhouettes, over the distance of the receiver. It tells which level to try;
  /// nothing relies on it. Scene units.
  float deviation = 0.0f;
  /// What the edge stands for is seen at most that far beside it; see MergedSides. Scene units.
  float margin = 0.0f;
  /// How far what lies between its chain and it is from it at most (EdgeChain::stray). Scene units.
  float stray = 0.0f;
  /// What of that may be taken for the wrong side, over the distance of the receiver. Square scene units.
  float swept = 0.0f;
  /// What is added to that times the distance, at any distance. Cubic scene units.
  float swept_at_any = 0.0f;
};

/// What the two sides of an edge stand for, in some frame.
///
/// A receiver x that sees a patch from both sides sees it edge-on. The patch lies in a slab that is `thick`
/// either way of its mean plane, and x is no farther from that plane than the planes of the patch's faces
/// differ there. So x sees the patch as a strip, and the outline of the patch runs all along that strip.
/// From x at twice the patch's radius or more the strip is seen as wide as 2 (thick + spread + radius ·
/// tilt) would be at the patch. Hence nothing of the patch is seen farther from its outline than that, nor
/// farther from the merged edges in place of its outline than that and what they were straightened by. This
/// sum is `margin`.
struct MergedSides {
  struct Side {
    /// Of a ball around the faces; the radius is 0 where a face is alone.
    Vec3 center{0.0};
    double radius = 0.0;
    /// The planes of the faces differ by at most tilt · (distance from the center) + spread.
    double tilt = 0.0, spread = 0.0;
    /// But for rounding (FacePatch::is_flat).
    bool is_flat = true;
    /// How much the planes differ at x. The sum of components is no less than the distance, and cheaper.
    double reach(const Vec3& x) const {
      return tilt * (std::abs(x.x - center.x) + std::abs(x.y - center.y) + std::abs(x.z - center.z)) + spread;
    }
    /// The margin holds for x.
    bool is_far(const Vec3& x) const { return glm::distance(x, center) >= 2.0 * radius; }
  };
  Side left, right;
  double margin = 0.0;
  /// A box around the edge with its margin, and around the faces of sides that are not flat.
  Vec3 middle{0.0}, half{0.0};
};

/// What of an edge may be taken for the wrong side, in some frame (face_patches.h, caster_merger.h).
struct MergedFaults {
  /// Of a side, as FacePatch has it, divided by the number of edges of the patch.
  struct Side {
    double area = 0.0, shifted = 0.0;
    glm::dmat3 turned{0.0};
  };
  Side left, right;
  /// MergedEdge::swept, MergedEdge::swept_at_any and MergedEdge::stray.
  double swept = 0.0, swept_at_any = 0.0, stray = 0.0;
};

/// Up to eight edges that lie close together, in some frame.
struct MergedBlock {
  static constexpr std::size_t kEdges = BoundsTree::kFanOut;
  std::size_t count = 0;
  std::array<BandEdge, kEdges> edges;
  std::array<MergedSides, kEdges> sides;
  std::array<MergedFaults, kEdges> faults;
  /// Makes each edge's box.
  void make_boxes();
  /// The bounds of the edges and of all faces that they stand for. Requires boxes.
  BlockBounds bounds() const;
};

}  // namespace penumbra::detail
