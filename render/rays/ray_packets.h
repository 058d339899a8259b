// Rays against the casters: sixteen at a time for occlusion, one by one for the first face on the way.
//
// In: origins and directions in the frame of the rays (RayFrame), float. Out: whether a face lies on the way,
// or which. Methods trace with these; Embree itself is included by render/rays only. The orientation of faces
// does not matter. Any number of threads may trace at once, best inside of RayScene::arena().
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>

#include "render/rays/ray_scene.h"

namespace penumbra::detail {

/// Sixteen rays. A packet is made once and used again and again: what stays the same from call to call is set
/// once. Embree reads and writes it in place; the order of the arrays is Embree's.
struct RayPacket {
  static constexpr std::size_t kRays = 16;

  alignas(64) float from_x[kRays]{}, from_y[kRays]{}, from_z[kRays]{};
  /// Faces nearer than this are not met; in units of the direction.
  float start[kRays]{};
  float way_x[kRays]{}, way_y[kRays]{}, way_z[kRays]{};
  float unused_time[kRays]{};
  /// Faces further away than this are not met; in units of the direction. To be set before every call, which
  /// overwrites it.
  float end[kRays]{};
  std::uint32_t unused_mask[kRays], unused_id[kRays]{}, unused_flags[kRays]{};
  /// Which rays are to be traced: -1, or 0 for those that are not.
  std::int32_t wanted[kRays]{};

  RayPacket() {
    for (std::uint32_t& mask : unused_mask) mask = ~0u;
  }
  /// After find_occluded: ray k was wanted and a face lies on its way.
  bool is_occluded(std::size_t k) const { return wanted[k] && end[k] < 0.0f; }
};

/// Which rays share a packet: Embree has a way of its own for either. Answers are the same but for roundings.
enum class Coherence {
  kCoherent,    ///< they start close to each other and run alike
  kIncoherent,  ///< they do not; also for rays that graze many faces
};

/// Whether a face of a caster lies between start and end of each wanted ray: RayPacket::is_occluded tells.
/// Cost O(log faces) a ray.
void find_occluded(const RayScene& rays, RayPacket& packet, Coherence coherence);

/// The first face that a ray meets.
struct RayHit {
  /// In units of the direction.
  float distance;
  /// Index in Scene::objects, and the face's in its mesh.
  std::uint32_t object, face;
};

/// The first face of a caster that the ray meets before `end` (in units of the direction, may be infinite).
/// None where it meets none. Cost O(log faces).
std::optional<RayHit> first_hit(const RayScene& rays, const glm::vec3& from, const glm::vec3& way, float end);

}  // namespace penumbra::detail
