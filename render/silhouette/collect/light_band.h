// Silhouette method, step 1 of 5: the light's frame, and in it every edge that can bound what a receiver sees.
//
// In: scene. Out: the silhouette band (volumes/silhouettes.h) of all casters, in a frame where the light is
// the unit disk in z = 0 and shines towards +z. Whatever lies behind the light's plane does not cast, so
// edges are cut there (where rays end, kLightOffset in front of it); where a face itself crosses that plane,
// the cut is one more edge with a face on one side only. Which edges the band has comes from a hierarchy that
// serves every light (scene_edges.h).
#pragma once

#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "render/silhouette/edges/band_edge.h"
#include "render/silhouette/edges/scene_edges.h"
#include "render/silhouette/merge/merged_edges.h"
#include "render/silhouette/merge/merged_lanes.h"
#include "render/support/large_array.h"

namespace penumbra::detail {

/// The frame: p → ((p - center)·u, (p - center)·v, (p - center)·w) / radius. u and v are turned against
/// those of the light, which often run along walls, bars and treads: no row of scanlines shall run along
/// them. Requires radius > 0.
class UnitLight {
 public:
  explicit UnitLight(const DiskLight& light);
  const DiskLight& disk() const { return disk_; }
  Vec3 point(const Vec3& world) const { return direction(world - center_) * per_radius_; }
  /// Rotated only.
  Vec3 direction(const Vec3& world) const {
    return {glm::dot(world, axes_.u), glm::dot(world, axes_.v), glm::dot(world, axes_.w)};
  }
  /// Rotated back.
  Vec3 world_direction(const Vec3& d) const { return d.x * axes_.u + d.y * axes_.v + d.z * axes_.w; }
  const Vec3& normal() const { return axes_.w; }
  Vec3 world_on_disk(const glm::dvec2& p) const { return center_ + p.x * across_ + p.y * up_; }
  double per_radius() const { return per_radius_; }

 private:
  DiskLight disk_;
  LightFrame axes_;
  Vec3 center_, across_, up_;  ///< across and up span the disk, their length is its radius
  double per_radius_;
};

/// What casts in a light's frame. Refers to its arguments.
struct LitScene {
  /// Without the casters whose flag in `cannot_occlude` (one an object, or none) is set; `edges` are the scene's. Cost
  /// O(vertices), a hundredth of them where neighbors in a mesh's arrays are neighbors in space.
  /// `receivers`: bounds of those that may lie outside of the scene's.
  LitScene(const Scene& scene, const UnitLight& light, const SceneEdges& edges, const Bounds& receivers = {},
           std::span<const char> cannot_occlude = {});

  const Scene& scene;
  const UnitLight& light;
  std::span<const char> cannot_occlude;
  double depth;               ///< of the plane where casters end, in front of the light's; light radii
  std::vector<Bounds> boxes;  ///< one an object, in the light's frame; empty for those that do not cast
  double extent = 1.0;        ///< largest absolute coordinate of the scene, in light radii (at least 1)
  bool all_in_front = true;   ///< of that plane

  bool casts(std::size_t object) const { return !boxes[object].empty(); }
};

struct Band {
  LargeArray<BandEdge> edges;   ///< neighbors lie close together; those of cut faces come last
  std::vector<Bounds> casters;  ///< box of each, in the light's frame
  double extent = 1.0;          ///< of the scene (LitScene)
  std::size_t faces = 0, mesh_edges = 0, cut_edges = 0;
  /// Of a band of merged edges, for every eight of them: what they and the faces that they stand for lie
  /// within, and how far the worst of them is moved (merged_edges.h; light radii).
  std::vector<BlockBounds> bounds;
  std::vector<float> deviation;
  LargeArray<MergedLanes> lanes;  ///< these edges in float
  /// And of each edge what its left and right side stand for.
  std::vector<MergedSides> sides;
  bool is_merged() const { return !deviation.empty(); }
  std::size_t bytes() const {
    return edges.size() * sizeof(BandEdge) + sides.size() * sizeof(MergedSides) +
           bounds.size() * (sizeof(BlockBounds) + sizeof(float) + sizeof(MergedLanes));
  }
};

/// Of all casters; `edges` are the scene's. A few edges more than the band has, by rounding. Where there are
/// `regions` only what matters to them. Cost O(band edges), and O(faces) of casters that are not all in front
/// of the light. On all cores. Deterministic.
Band make_band(const LitScene& lit, const SceneEdges& edges, std::span<const ReceiverRegion> regions = {});
/// All of a level's edges. Requires all casters in front of the light.
Band make_merged_band(const LitScene& lit, const MergedEdges& edges, const MergedLevel& level);

}  // namespace penumbra::detail
