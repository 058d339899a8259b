// Accurate rung, step 1 of 5: the light's frame, and in it every edge that can bound what a receiver sees.
//
// In: scene. Out: the silhouette band (volumes/silhouette.h) of all casters, in a frame where the light is
// the unit disk in z = 0 and shines towards +z. Whatever lies behind the light's plane does not cast, so
// edges are cut there; where a face itself crosses that plane, the cut is one more edge with a face on one
// side only. (Strictly classified faces need none: their plane, hence the cut, misses the disk.)
//
// An edge a → b seen from x is a line across the disk. The number of faces that hide a point of the disk
// jumps there by `jump_at`, faces on its left minus faces on its right, and on which side a face lies is the
// sign of its plane at x. That is true whether meshes are closed, open, not manifold or inconsistently wound;
// edges that are no silhouette from x have a jump of 0.
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "render/large_array.h"
#include "render/scene.h"

namespace penumbra::detail {

/// The frame: p → ((p - center)·u, (p - center)·v, (p - center)·w) / radius. Requires radius > 0.
class UnitLight {
 public:
  explicit UnitLight(const DiskLight& light);
  Vec3 point(const Vec3& world) const { return direction(world - center_) * per_radius_; }
  /// Rotated only.
  Vec3 direction(const Vec3& world) const {
    return {glm::dot(world, axes_.u), glm::dot(world, axes_.v), glm::dot(world, axes_.w)};
  }
  Vec3 world_on_disk(const glm::dvec2& p) const { return center_ + p.x * across_ + p.y * up_; }
  double per_radius() const { return per_radius_; }

 private:
  LightFrame axes_;
  Vec3 center_, across_, up_;  ///< across and up span the disk, their length is its radius
  double per_radius_;
};

/// The plane of a face: value(x) = normal·x + offset is x's distance in light radii, positive where the face
/// is seen counter-clockwise. Beyond ±tolerance the sign is that of the exact value for the vertices as
/// given: with coordinates up to M, each off by a few u M (u = 2^-53), N = E1 × E2 is off by a few u M (|E1|
/// + |E2|), and that times a distance of at most 4M, over |N|, is what the tolerance bounds (with u = 2^-46).
/// A face without area has normal 0, and no sign of it is certain.
struct FacePlane {
  Vec3 normal;
  double offset, tolerance;
  double value(const Vec3& x) const { return normal.x * x.x + normal.y * x.y + normal.z * x.z + offset; }
};

/// In place of a face that is missing: surely on neither side.
inline const FacePlane kNoFace{Vec3(0.0), 0.0, -1.0};

/// (Nothing is initialized by itself: a band's memory is first touched by whoever fills it.)
struct BandEdge {
  Vec3 a, b;              ///< z ≥ 0
  FacePlane left, right;  ///< of the faces that run a → b and b → a; kNoFace without a right one
  bool has_right;
};

/// Faces on the left minus faces on the right of a → b, as seen from x.
inline int jump_at(const BandEdge& e, const Vec3& x) {
  return (e.left.value(x) > 0.0 ? 1 : -1) + (e.has_right ? (e.right.value(x) > 0.0 ? -1 : 1) : 0);
}

struct Band {
  LargeArray<BandEdge> edges;   ///< along a Morton curve: neighbours lie close together
  std::vector<Bounds> casters;  ///< box of each, in the light's frame
  double extent = 1.0;          ///< largest absolute coordinate in the scene, in light radii (at least 1)
  std::size_t faces = 0, mixed_faces = 0, mesh_edges = 0, cut_edges = 0;
};

/// Of all casters but those whose flag in `idle` (one an object, or none) is set. Cost O(faces + band edges),
/// on all cores. Deterministic. Requires radius > 0.
Band make_band(const Scene& scene, const UnitLight& light, std::span<const char> idle = {});

}  // namespace penumbra::detail
