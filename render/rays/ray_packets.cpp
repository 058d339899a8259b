#include "render/rays/ray_packets.h"

#include <algorithm>
#include <array>

#include "render/rays/hit_filter.h"

namespace penumbra::detail {
namespace {

constexpr std::size_t kRays = RayPacket::kRays;

RTCIntersectContextFlags flags_of(Coherence coherence) {
  return coherence == Coherence::kIncoherent ? RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT
                                             : RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
}

void trace_singly(const RayGroup& group, RTCIntersectContext& context, GroupRays& rays) {
  for (unsigned k = 0; k < kRays; ++k) {
    if (!rays.valid[k]) continue;
    RTCRay ray = rtcGetRayFromRayN(reinterpret_cast<RTCRayN*>(&rays.ray), kRays, k);
    rtcOccluded1(group.scene, &context, &ray);
    rays.ray.tfar[k] = ray.tfar;
  }
}

/// Adds the rays to `occluded` that a face of the group hides, of those that none hides yet.
void find_occluded_by(const RayGroup& group, RayPacket& packet, Coherence coherence, GroupRays& rays) {
  alignas(64) std::int32_t open[kRays];
  for (std::size_t k = 0; k < kRays; ++k) open[k] = packet.wanted[k] & ~packet.occluded[k];
  if (!rays.set(packet, open, group.frame)) return;
  HitQuery query(packet, rays, group, flags_of(coherence));
  if (coherence == Coherence::kSingly)
    trace_singly(group, query.context, rays);
  else
    rtcOccluded16(rays.valid, group.scene, &query.context, &rays.ray);
  // Embree sets tfar to -infinity at a hit.
  for (std::size_t k = 0; k < kRays; ++k)
    packet.occluded[k] |= rays.valid[k] & (rays.ray.tfar[k] < 0.0f ? -1 : 0);
}

/// Rays that leave their own face so flat that float may pass over all that stands on it.
void find_occluded_beside_own(const RayScene::Impl& rays, RayPacket& packet) {
  std::int32_t object = -1;
  std::uint32_t face = 0;
  RayScene::Impl::OfObject of;
  FaceCorners corners{};
  for (std::size_t k = 0; k < kRays; ++k) {
    if ((packet.wanted[k] & ~packet.occluded[k]) == 0 || packet.object[k] < 0) continue;
    if (packet.object[k] != object || packet.face[k] != face) {
      object = packet.object[k], face = packet.face[k];
      of = rays.of_face(object, face);
      if (of.geometry) corners = of.geometry->corners(face);
    }
    if (!of.geometry || !is_flat(corners, packet.way(k), kLeavesFlat)) continue;
    const SegmentEnds ends = ends_of(packet, k, of.group->frame);
    if (hiding_face_along(of.geometry->scaled(), face, face, ends.x, ends.q,
                          {.reach = kBeside, .forward_only = true}))
      packet.occluded[k] = -1;
  }
}

}  // namespace

void find_occluded(const RayScene& rays, RayPacket& packet, Coherence coherence) {
  std::fill_n(packet.occluded, kRays, 0);
  GroupRays of_group;
  for (const auto& group : rays.impl().casters) find_occluded_by(*group, packet, coherence, of_group);
  find_occluded_beside_own(rays.impl(), packet);
}

std::optional<RayHit> first_hit(const RayScene& rays, const Ray& ray) {
  RayPacket packet;
  packet.set_start(0, ray.from);
  packet.set_way(0, ray.way);
  packet.endless = ray.endless;
  packet.wanted[0] = -1;
  GroupRays of_group;
  std::array<NearestHit, kRays> nearest;
  std::optional<RayHit> first;
  for (const auto& group : rays.impl().casters) {
    if (!of_group.set(packet, packet.wanted, group->frame)) continue;
    find_nearest(*group, packet, of_group, nearest);
    const NearestHit& hit = nearest[0];
    if (!hit.geometry) continue;
    const double distance = distance_to(*hit.geometry, hit.face, ray.from.point, ray.way);
    if (!first || distance < first->distance) first = RayHit{distance, hit.geometry->object, hit.face};
  }
  return first;
}

}  // namespace penumbra::detail
