#include "render/rays/ray_packets.h"

#include "render/rays/ray_scene_impl.h"

namespace penumbra::detail {
namespace {

// Copying a packet would cost up to a tenth of tracing it, so the packet is handed over as it lies in memory.
static_assert(offsetof(RayPacket, from_x) == offsetof(RTCRay16, org_x));
static_assert(offsetof(RayPacket, start) == offsetof(RTCRay16, tnear));
static_assert(offsetof(RayPacket, way_x) == offsetof(RTCRay16, dir_x));
static_assert(offsetof(RayPacket, unused_time) == offsetof(RTCRay16, time));
static_assert(offsetof(RayPacket, end) == offsetof(RTCRay16, tfar));
static_assert(offsetof(RayPacket, unused_mask) == offsetof(RTCRay16, mask));
static_assert(offsetof(RayPacket, unused_id) == offsetof(RTCRay16, id));
static_assert(offsetof(RayPacket, unused_flags) == offsetof(RTCRay16, flags));
static_assert(offsetof(RayPacket, wanted) == sizeof(RTCRay16) && alignof(RayPacket) == alignof(RTCRay16));

RTCIntersectContext context_for(Coherence coherence) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = coherence == Coherence::kCoherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT
                                                    : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  return context;
}

}  // namespace

void find_occluded(const RayScene& rays, RayPacket& packet, Coherence coherence) {
  RTCIntersectContext context = context_for(coherence);
  // Embree sets tfar, our `end`, to -infinity at a hit.
  rtcOccluded16(packet.wanted, rays.impl().casters, &context, reinterpret_cast<RTCRay16*>(&packet));
}

std::optional<RayHit> first_hit(const RayScene& rays, const glm::vec3& from, const glm::vec3& way,
                                float end) {
  RTCRayHit query{};
  query.ray.org_x = from.x, query.ray.org_y = from.y, query.ray.org_z = from.z;
  query.ray.dir_x = way.x, query.ray.dir_y = way.y, query.ray.dir_z = way.z;
  query.ray.tfar = end;
  query.ray.mask = ~0u;
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  RTCIntersectContext context = context_for(Coherence::kIncoherent);
  rtcIntersect1(rays.impl().casters, &context, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  return RayHit{query.ray.tfar, query.hit.geomID, query.hit.primID};
}

}  // namespace penumbra::detail
