// Accurate rung, step 1 of 5: the light's frame, and in it every edge that can bound what a receiver sees.
//
// In: scene. Out: the silhouette band (volumes/silhouette.h) of all casters, in a frame where the light is
// the unit disk in z = 0 and shines towards +z. Whatever lies behind the light's plane does not cast, so
// edges are cut there (where rays end, kLightOffset in front of it); where a face itself crosses that plane,
// the cut is one more edge with a face on one side only. Which edges the band has comes from a hierarchy that
// serves every light (scene_edges.h).
#pragma once

#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "render/band_edge.h"
#include "render/large_array.h"
#include "render/scene_edges.h"

namespace penumbra::detail {

/// The frame: p → ((p - center)·u, (p - center)·v, (p - center)·w) / radius. u and v are turned against
/// those of the light, which often run along walls, bars and treads: no row of scanlines shall run along
/// them. Requires radius > 0.
class UnitLight {
 public:
  explicit UnitLight(const DiskLight& light);
  Vec3 point(const Vec3& world) const { return direction(world - center_) * per_radius_; }
  /// Rotated only.
  Vec3 direction(const Vec3& world) const {
    return {glm::dot(world, axes_.u), glm::dot(world, axes_.v), glm::dot(world, axes_.w)};
  }
  const Vec3& normal() const { return axes_.w; }
  Vec3 world_on_disk(const glm::dvec2& p) const { return center_ + p.x * across_ + p.y * up_; }
  double per_radius() const { return per_radius_; }

 private:
  LightFrame axes_;
  Vec3 center_, across_, up_;  ///< across and up span the disk, their length is its radius
  double per_radius_;
};

struct Band {
  LargeArray<BandEdge> edges;   ///< neighbours lie close together; those of cut faces come last
  std::vector<Bounds> casters;  ///< box of each, in the light's frame
  double extent = 1.0;          ///< largest absolute coordinate in the scene, in light radii (at least 1)
  std::size_t faces = 0, mesh_edges = 0, cut_edges = 0;
};

/// Of all casters but those whose flag in `idle` (one an object, or none) is set; `edges` are the scene's.
/// A few edges more than the band has, by rounding. Cost O(band edges + vertices), on all cores.
/// Deterministic. Requires radius > 0.
Band make_band(const Scene& scene, const UnitLight& light, const SceneEdges& edges,
               std::span<const char> idle = {});

}  // namespace penumbra::detail
