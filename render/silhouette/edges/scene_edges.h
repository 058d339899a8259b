// All edges of a scene's casters, and which of them may belong to a light's silhouette band.
//
// In: casters, once. Out: for any disk light, the edges of its band (volumes/silhouettes.h) without a look at
// every face. Edges that lie close together are neighbors, eight a block (halved across the longest side,
// over and over); over the blocks stands a hierarchy of boxes and of the planes of their faces
// (bounds_tree.h). Where all faces of a block look at the light, or all away from it, none of its edges is in
// the band; and the share of those blocks grows with the mesh.
//
// All is in float, in the frame of rays. Where that leaves a doubt an edge is kept: a few more than the band
// has do no harm, since what an edge does to a receiver is decided for that receiver.
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
  std::uint32_t object;  ///< index in the scene
  EdgeId id;             ///< of its mesh
};

/// A light in float, in the frame of the edges.
struct FloatDisk {
  /// In the frame (p - origin) · scale.
  FloatDisk(const DiskLight& light, const Vec3& origin, double scale);
  FloatBox box;
  SplitPoint center;
  std::array<float, 3> normal;
  float radius2, margin;
};

class SceneEdges {
 public:
  /// In the frame (p - origin) · scale, which takes all of the scene into [-1, 1]. Cost O(E log E), most of
  /// it on all cores; some 60 bytes an edge.
  SceneEdges(const Scene& scene, const Vec3& origin, double scale);
  /// Those of the light's band, neighbors close together, but for objects whose flag in `cannot_occlude` (one an
  /// object, or none) is set. Cost O(band + √E), on all cores.
  std::vector<SceneEdge> band_of(const DiskLight& light, std::span<const char> cannot_occlude) const;
  /// At least as many as these, within a few times. Cost O(√E) where the surface is fine.
  std::size_t size_of_band(const DiskLight& light) const;
  /// Of these what may matter to the receivers of some regions. Cost: some 10 μs a region on a fine surface.
  std::vector<SceneEdge> band_for(std::span<const ReceiverRegion> regions, const Scene& scene,
                                  const DiskLight& light, std::span<const char> cannot_occlude) const;
  std::size_t size() const { return edges_.size(); }
  /// Of one object that casts, by its index in the scene.
  const PointGroups& points(std::size_t object) const { return points_[object]; }
  double scale() const { return scale_; }
  std::size_t bytes() const;

 private:
  void mark_needed(const ReceiverRegion& region, const Scene& scene,
                   std::vector<std::atomic<std::uint8_t>>& needed) const;
  /// Some edges of a block, bit by bit, but for those of objects that cannot occlude.
  void add_block(std::size_t block, std::uint32_t edges, std::span<const char> cannot_occlude,
                 std::vector<SceneEdge>& out) const;

  Vec3 origin_;
  double scale_;
  LargeArray<SceneEdge> edges_;
  LargeArray<LocalPlanes> planes_;  ///< of eight edges each
  BoundsTree tree_;
  std::vector<PointGroups> points_;
};

}  // namespace penumbra::detail
