// Rays from receivers to points of a light: sixteen at a time for occlusion, one by one for the first face on
// the way.
//
// In: receivers and ways in world coordinates, double. Out: whether a face of a caster lies on the way, or
// which. Embree's float rays are a filter: what they cannot tell is decided in double (hit_filter.h), so that
// rays start exactly at the receiver and end exactly at the light. A face in whose plane the receiver or the
// light point lies, as far as double can tell, hides nothing, nor does the receiver's own face. Only where a
// ray grazes both faces of a silhouette edge, and passes it within float's rounding of the group's frame
// (ray_groups.h), some 1e-7 of its extent, may either answer come out.
//
// Methods trace with these; Embree itself is included by render/rays only. The orientation of faces does not
// matter. Any number of threads may trace at once, best inside of RayScene::arena().
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "penumbra/render/receivers/receivers.h"
#include "render/rays/ray_scene.h"

namespace penumbra::detail {

/// Where a ray starts, in world coordinates, and the face that it starts on.
struct RayStart {
  Vec3 point{0.0};
  /// As in Scene::objects; -1: no face is known.
  std::int32_t object = -1;
  std::uint32_t face = 0;
};

inline RayStart start_of(const Receivers& receivers, std::size_t i) {
  if (receivers.faces.empty() || receivers.objects.empty()) return {.point = receivers.points[i]};
  return {receivers.points[i], receivers.objects[i], receivers.faces[i]};
}

struct Ray {
  RayStart from;
  /// From the start to the light point; of a distant light the direction towards it, of any length.
  Vec3 way{0.0};
  /// The light is distant: the ray has no end.
  bool endless = false;
};

/// Sixteen rays. A packet is made once and used again and again: what stays the same from call to call is set
/// once.
struct RayPacket {
  static constexpr std::size_t kRays = 16;

  /// Of RayStart, one entry a ray.
  alignas(64) double from_x[kRays]{}, from_y[kRays]{}, from_z[kRays]{};
  std::int32_t object[kRays];
  std::uint32_t face[kRays]{};
  /// As in Ray.
  double way_x[kRays]{}, way_y[kRays]{}, way_z[kRays]{};
  /// Of all rays.
  bool endless = false;
  /// Which rays are to be traced: -1, or 0 for those that are not.
  alignas(64) std::int32_t wanted[kRays]{};
  /// Written by find_occluded: -1 where the ray was wanted and a face lies on its way, else 0.
  std::int32_t occluded[kRays]{};

  /// Kept by find_occluded from call to call: what it knows of the face on which rays start.
  struct OwnFace {
    const void* scene = nullptr;
    std::int32_t object = -1;
    std::uint32_t face = 0;
    Vec3 normal{0.0};
    double steepest = 0.0;
  };
  OwnFace own;

  RayPacket() {
    for (std::int32_t& each : object) each = -1;
  }
  void set_start(std::size_t k, const RayStart& start) {
    from_x[k] = start.point.x, from_y[k] = start.point.y, from_z[k] = start.point.z;
    object[k] = start.object, face[k] = start.face;
  }
  void set_way(std::size_t k, const Vec3& way) { way_x[k] = way.x, way_y[k] = way.y, way_z[k] = way.z; }
  /// All but `endless`.
  void set(std::size_t k, const Ray& ray) {
    set_start(k, ray.from);
    set_way(k, ray.way);
  }
  Vec3 start(std::size_t k) const { return {from_x[k], from_y[k], from_z[k]}; }
  Vec3 way(std::size_t k) const { return {way_x[k], way_y[k], way_z[k]}; }
  bool is_occluded(std::size_t k) const { return occluded[k] != 0; }
};

/// Which rays share a packet: Embree has a way of its own for each. Answers are the same but for roundings.
enum class Coherence {
  kCoherent,    ///< they start close to each other and run alike
  kIncoherent,  ///< they do not; also for rays that graze many faces
  kSingly,      ///< one by one
};

/// Whether a face of a caster lies on the way of each wanted ray: RayPacket::occluded tells. Cost O(log
/// faces) a ray.
void find_occluded(const RayScene& rays, RayPacket& packet, Coherence coherence);

/// The first face that a ray meets.
struct RayHit {
  /// In units of the way, in double from the face's plane.
  double distance;
  /// Index in Scene::objects, and the face's in its mesh.
  std::uint32_t object, face;
};

/// The first face of a caster that the ray meets. None where it meets none. Cost O(log faces).
std::optional<RayHit> first_hit(const RayScene& rays, const Ray& ray);

}  // namespace penumbra::detail
