#include "render/rays/hit_filter.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "mesh/vectors.h"

namespace penumbra::detail {
namespace {

/// Of Embree's arguments what a filter needs, for one of the rays.
struct Hit {
  Hit(const RTCFilterFunctionNArguments& from, unsigned i)
      : ray(RTCRayN_id(from.ray, from.N, i)),
        primitive(RTCHitN_primID(from.hit, from.N, i)),
        at(RTCRayN_tfar(from.ray, from.N, i)),
        u(RTCHitN_u(from.hit, from.N, i)),
        v(RTCHitN_v(from.hit, from.N, i)),
        normal(RTCHitN_Ng_x(from.hit, from.N, i), RTCHitN_Ng_y(from.hit, from.N, i),
               RTCHitN_Ng_z(from.hit, from.N, i)),
        slope(std::abs(normal.x * RTCRayN_dir_x(from.ray, from.N, i) +
                       normal.y * RTCRayN_dir_y(from.ray, from.N, i) +
                       normal.z * RTCRayN_dir_z(from.ray, from.N, i))) {}

  /// Float knows that it lies between receiver and light point; or that it does not.
  bool is_between(const GroupRays& rays, const RayGeometry& geometry) const {
    return (at - rays.at_start[ray]) * slope > geometry.clear &&
           (rays.at_end[ray] - at) * slope > geometry.clear;
  }
  bool is_beyond(const GroupRays& rays, const RayGeometry& geometry) const {
    return (rays.at_start[ray] - at) * slope > geometry.clear ||
           (at - rays.at_end[ray]) * slope > geometry.clear;
  }
  /// Float knows that it lies within the face.
  bool is_within(const RayGeometry& geometry) const {
    return std::min({u, v, 1.0f - u - v}) * slope > geometry.border;
  }

  std::uint32_t ray, primitive;
  float at, u, v;
  glm::vec3 normal;
  float slope;  ///< |N·d|
};

bool is_own(const RayPacket& packet, std::size_t k, const RayGeometry& geometry, std::uint32_t face) {
  return packet.face[k] == face && packet.object[k] == static_cast<std::int32_t>(geometry.object);
}

/// The face that the hit stands for, by double and exact predicates where that is needed; none if it does not
/// count.
std::optional<std::uint32_t> face_of(const Hit& hit, const RayGeometry& geometry, const HitQuery& query) {
  const std::uint32_t face = geometry.face(hit.primitive);
  if (is_own(query.packet, hit.ray, geometry, face)) return std::nullopt;
  const bool between = hit.is_between(query.rays, geometry);
  if (between && hit.is_within(geometry)) return face;
  if (!between && hit.is_beyond(query.rays, geometry)) return std::nullopt;
  const SegmentEnds ends = ends_of(query.packet, hit.ray, query.group.frame);
  const FaceCorners corners = geometry.corners(face);
  if (!between && !separates(corners, ends.x, ends.q)) return std::nullopt;
  if (line_meets(corners, ends.x, ends.q)) return face;
  if (!is_flat(corners, ends.q - ends.x, kGrazing)) return std::nullopt;
  const bool own = query.packet.object[hit.ray] == static_cast<std::int32_t>(geometry.object);
  return hiding_face_along(geometry.scaled(), face, own ? query.packet.face[hit.ray] : -1, ends.x, ends.q,
                           {kBeside});
}

/// Where ray k meets the face's plane, in units of its way.
double distance_of(const HitQuery& query, std::size_t k, const NearestHit& hit) {
  return distance_to(*hit.geometry, hit.face, query.packet.start(k), query.packet.way(k));
}

}  // namespace

HitQuery::HitQuery(const RayPacket& packet_, const GroupRays& rays_, const RayGroup& group_,
                   RTCIntersectContextFlags flags)
    : packet(packet_), rays(rays_), group(group_) {
  rtcInitIntersectContext(&context);
  context.flags = flags;
}

bool is_flat(const FaceCorners& face, const Vec3& way, double sine) {
  const Vec3 n = glm::cross(face.b - face.a, face.c - face.a);
  const double across = glm::dot(n, way);
  return across * across < sine * sine * glm::dot(n, n) * glm::dot(way, way);
}

double distance_to(const RayGeometry& geometry, std::uint32_t face, const Vec3& from, const Vec3& way) {
  const FaceCorners f = geometry.corners(face);
  const Vec3 n = glm::cross(f.b - f.a, f.c - f.a);
  return glm::dot(n, f.a - from * geometry.scale) / glm::dot(n, way * geometry.scale);
}

SegmentEnds ends_of(const RayPacket& packet, std::size_t k, const GroupFrame& frame) {
  const Vec3 x = packet.start(k) * frame.scale, way = packet.way(k);
  if (!packet.endless) return {x, x + way * frame.scale};
  // As far as the box and once again, and so far that adding x does not turn the direction.
  const double beyond =
      8.0 * std::max({1.0, largest_component(x), largest_component(x - frame.origin * frame.scale)});
  return {x, x + beyond * scaled_to_one(way)};
}

void filter_occluded(const RTCFilterFunctionNArguments* arguments) {
  const auto& geometry = *static_cast<const RayGeometry*>(arguments->geometryUserPtr);
  HitQuery& query = *reinterpret_cast<HitQuery*>(arguments->context);
  for (unsigned i = 0; i < arguments->N; ++i)
    if (arguments->valid[i] && !face_of(Hit(*arguments, i), geometry, query)) arguments->valid[i] = 0;
}

/// An accepted hit leaves the ray longer than itself, by the errors of two places, so that Embree still
/// reports faces that may lie before it. Those are compared in double.
void filter_nearest(const RTCFilterFunctionNArguments* arguments) {
  constexpr float kMostError = 0x1p-10f;  // of a place on a face that the ray grazes
  const auto& geometry = *static_cast<const RayGeometry*>(arguments->geometryUserPtr);
  HitQuery& query = *reinterpret_cast<HitQuery*>(arguments->context);
  for (unsigned i = 0; i < arguments->N; ++i) {
    if (!arguments->valid[i]) continue;
    const Hit hit(*arguments, i);
    NearestHit& best = query.nearest[hit.ray];
    const NearestHit mine{&geometry, geometry.face(hit.primitive), hit.at,
                          std::min(geometry.clear / hit.slope, kMostError)};
    const bool is_close = best.geometry && std::abs(mine.at - best.at) <= mine.error + best.error;
    const bool is_behind =
        best.geometry && (is_close ? distance_of(query, hit.ray, mine) >= distance_of(query, hit.ray, best)
                                   : mine.at > best.at);
    const auto face = is_behind ? std::nullopt : face_of(hit, geometry, query);
    if (!face) {
      arguments->valid[i] = 0;
      continue;
    }
    best = mine;
    best.face = *face;
    RTCRayN_tfar(arguments->ray, arguments->N, i) = mine.at + mine.error + kMostError;
  }
}

void find_nearest(const RayGroup& group, const RayPacket& packet, GroupRays& rays,
                  std::span<NearestHit, RayPacket::kRays> out) {
  std::ranges::fill(out, NearestHit{});
  HitQuery query(packet, rays, group, RTC_INTERSECT_CONTEXT_FLAG_COHERENT);
  query.nearest = out.data();
  RTCRayHit16 traced;
  traced.ray = rays.ray;
  for (std::size_t k = 0; k < RayPacket::kRays; ++k) {
    traced.hit.geomID[k] = RTC_INVALID_GEOMETRY_ID;
    traced.hit.instID[0][k] = RTC_INVALID_GEOMETRY_ID;
  }
  rtcIntersect16(rays.valid, group.scene, &query.context, &traced);
}

}  // namespace penumbra::detail
