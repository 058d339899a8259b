#include "render/rays/ray_packets.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>

#include "render/rays/hit_filter.h"
#include "render/support/vector_clones.h"

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

/// All rays start on one face.
PENUMBRA_VECTOR_CLONES
bool are_of_one_face(const RayPacket& packet) {
  std::int32_t other = 0;
  for (std::size_t k = 0; k < kRays; ++k)
    other |=
        (packet.object[k] ^ packet.object[0]) | static_cast<std::int32_t>(packet.face[k] ^ packet.face[0]);
  return other == 0;
}

/// Whether a ray that still counts leaves a plane flat, by the square of the plane's normal times that of the
/// sine.
PENUMBRA_VECTOR_CLONES
bool is_any_flat(const RayPacket& packet, const Vec3& normal, double steepest) {
  std::int64_t any = 0;
  for (std::size_t k = 0; k < kRays; ++k) {
    const double x = packet.way_x[k], y = packet.way_y[k], z = packet.way_z[k];
    const double across = normal.x * x + normal.y * y + normal.z * z;
    const bool flat = across * across < steepest * (x * x + y * y + z * z);
    any |= flat ? packet.wanted[k] & ~packet.occluded[k] : 0;
  }
  return any != 0;
}

/// The plane of a ray's own face, as RayPacket keeps it.
RayPacket::OwnFace own_face(const RayScene::Impl& rays, const RayPacket& packet, std::size_t k) {
  RayPacket::OwnFace own{&rays, packet.object[k], packet.face[k], Vec3(0.0), 0.0};
  const RayGeometry* geometry = rays.of_face(own.object, own.face).geometry;
  if (!geometry) return own;
  const FaceCorners f = geometry->corners(own.face);
  own.normal = glm::cross(f.b - f.a, f.c - f.a);
  own.steepest = kLeavesFlat * kLeavesFlat * glm::dot(own.normal, own.normal);
  return own;
}

/// A ray that leaves its own face so flat that float may pass over all that stands on it.
void look_beside_own(const RayScene::Impl& rays, RayPacket& packet, std::size_t k) {
  const auto of = rays.of_face(packet.object[k], packet.face[k]);
  if (!of.geometry) return;
  const SegmentEnds ends = ends_of(packet, k, of.group->frame);
  if (hiding_face_along(of.geometry->scaled(), packet.face[k], packet.face[k], ends.x, ends.q,
                        {.reach = kBeside, .forward_only = true}))
    packet.occluded[k] = -1;
}

void find_occluded_beside_own(const RayScene::Impl& rays, RayPacket& packet) {
  const bool one = are_of_one_face(packet);
  RayPacket::OwnFace& own = packet.own;
  const auto look_up = [&](std::size_t k) {
    if (own.scene != &rays || own.object != packet.object[k] || own.face != packet.face[k])
      own = own_face(rays, packet, k);
  };
  if (one) {
    look_up(0);
    if (!is_any_flat(packet, own.normal, own.steepest)) return;
  }
  for (std::size_t k = 0; k < kRays; ++k) {
    if (packet.object[k] < 0 || (packet.wanted[k] & ~packet.occluded[k]) == 0) continue;
    look_up(k);
    const Vec3 way = packet.way(k);
    const double across = glm::dot(own.normal, way);
    if (across * across < own.steepest * glm::dot(way, way)) look_beside_own(rays, packet, k);
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
