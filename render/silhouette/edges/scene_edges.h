// Silhouette method, step edges: all edges of a scene's casters, and which of them may be in a light's band.
//
// In: the casters, once. Out: for any circular light, the edges of its silhouette band
// (volumes/silhouettes.h), without a look at every face.
//
// Edges that lie close together are neighbors, eight a block: the edges are halved across the longest side
// of their box, over and over. A tree of bounds stands over the blocks (bounds_tree.h). Where all faces of
// a block look at the light, or all away from it, none of its edges is in the band. The share of such
// blocks grows with the mesh.
//
// All is in float, in the frame of rays: (p - origin) · scale. Where floats leave it open an edge is kept.
// A few edges more than the band has do no harm, since each receiver decides for itself what an edge does.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

#include "penumbra/render/scene/scene.h"
#include "render/silhouette/edges/bounds_tree.h"
#include "render/silhouette/edges/plane_lanes.h"
#include "render/silhouette/edges/point_groups.h"
#include "render/silhouette/edges/receiver_region.h"
#include "render/support/large_array.h"

namespace penumbra::detail {

struct SceneEdge {
  /// Index in the scene.
  std::uint32_t object;
  /// An edge of its mesh.
  EdgeId id;
};

/// A circular light in float, in the frame (p - origin) · scale, with homogeneous coordinates: of a light
/// that is far away the center and the radius are divided by its distance, or about that. Doubles are rounded
/// with a margin.
struct FloatDisk {
  FloatDisk(const CircularLight& light, const Vec3& origin, double scale);
  /// 1 for a light within [-1, 1], less the farther it is, 0 for a distant one.
  float weight;
  /// Around the disk.
  FloatBox box;
  SplitPoint center;
  std::array<float, 3> normal;
  float radius2, margin;
};

class SceneEdges {
 public:
  /// In the frame (p - origin) · scale, which takes all casters into [-1, 1]. Cost O(E log E), most of
  /// it on all cores; some 60 bytes an edge.
  SceneEdges(const Scene& scene, const Vec3& origin, double scale);
  /// The edges of the light's band, neighbors close together. `cannot_occlude`: a flag an object, or none
  /// at all; edges of objects whose flag is set are left out. Cost O(band + √E), on all cores.
  std::vector<SceneEdge> band_of(const CircularLight& light, std::span<const char> cannot_occlude) const;
  /// As many edges as `band_of` has, or up to a few times as many. Cost O(√E) where the surface is fine.
  std::size_t size_of_band(const CircularLight& light) const;
  /// Of the band those edges that may matter to the receivers of some regions. Cost: some 10 μs a region on
  /// a fine surface.
  std::vector<SceneEdge> band_for(std::span<const ReceiverRegion> regions, const Scene& scene,
                                  const CircularLight& light, std::span<const char> cannot_occlude) const;
  std::size_t size() const { return edges_.size(); }
  /// The points of an object that casts, by its index in the scene.
  const PointGroups& points(std::size_t object) const { return points_[object]; }
  /// Units of the frame in one scene unit.
  double scale() const { return scale_; }
  std::size_t bytes() const;

 private:
  /// Sets the bits of those edges, block by block, that a region's receivers have to look at.
  void mark_needed(const ReceiverRegion& region, const Scene& scene,
                   std::vector<std::atomic<std::uint8_t>>& needed) const;
  /// Appends the edges of a block whose bits are set, without those of objects that cannot occlude.
  void add_block(std::size_t block, std::uint32_t edges, std::span<const char> cannot_occlude,
                 std::vector<SceneEdge>& out) const;

  Vec3 origin_;
  double scale_;
  LargeArray<SceneEdge> edges_;
  /// One entry a block.
  LargeArray<LocalPlanes> planes_;
  BoundsTree tree_;
  /// One entry an object; without points for objects that do not cast.
  std::vector<PointGroups> points_;
};

}  // namespace penumbra::detail
