#include "render/silhouette/light_rays.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "penumbra/volumes/predicates/predicates.h"
#include "render/rays/ray_scene_impl.h"
#include "render/rays/ray_start.h"

namespace penumbra::detail {
namespace {

constexpr std::size_t kLanes = 16;

constexpr float kStepBack = 0.8f * static_cast<float>(kRayOffset);

struct LocalRay {
  glm::vec3 from, way;
};

LocalRay local_ray(const RayFrame& frame, const Receivers& receivers, std::uint32_t index, const Vec3& aim) {
  const glm::vec3 from = ray_start(receivers, index, frame).origin;
  return {from, glm::vec3(frame.to_local(aim)) - from};
}

void set_lane(const RayTask& task, const RayFrame& frame, const Receivers& receivers, const UnitLight& light,
              std::size_t k, RTCRay16& packet) {
  LocalRay ray = local_ray(frame, receivers, task.index, light.world_on_disk(task.aim));
  if (task.step_back) {
    const glm::vec3 step = (kStepBack / glm::length(ray.way)) * ray.way;
    ray.from -= step, ray.way += step;
  }
  packet.org_x[k] = ray.from.x, packet.org_y[k] = ray.from.y, packet.org_z[k] = ray.from.z;
  packet.dir_x[k] = ray.way.x, packet.dir_y[k] = ray.way.y, packet.dir_z[k] = ray.way.z;
  packet.tnear[k] = 0.0f, packet.time[k] = 0.0f;
  packet.tfar[k] = ray_end(-glm::dot(ray.way, glm::vec3(light.normal())));
  packet.mask[k] = ~0u, packet.id[k] = 0, packet.flags[k] = 0;
}

/// The open segment p q passes through the inside of triangle (a, b, c).
bool crosses(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Sign before = orient3d(a, b, c, p), after = orient3d(a, b, c, q);
  if (before == Sign::kZero || after == Sign::kZero || before == after) return false;
  const Sign side = orient3d(p, q, a, b);
  return side != Sign::kZero && orient3d(p, q, b, c) == side && orient3d(p, q, c, a) == side;
}

}  // namespace

double receiver_offset(const RayFrame& frame) {
  return kRayOffset / frame.scale;
}

void trace_tasks(const RayScene& rays, const Receivers& receivers, const UnitLight& light,
                 std::span<RayTask> tasks) {
  alignas(64) RTCRay16 packet;
  alignas(64) int valid[kLanes];
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  for (std::size_t first = 0; first < tasks.size(); first += kLanes) {
    const std::size_t count = std::min(kLanes, tasks.size() - first);
    for (std::size_t k = 0; k < kLanes; ++k) {
      valid[k] = k < count ? -1 : 0;
      set_lane(tasks[first + std::min(k, count - 1)], rays.frame(), receivers, light, k, packet);
    }
    rtcOccluded16(valid, rays.impl().casters, &context, &packet);
    // Embree sets tfar to -infinity at a hit.
    for (std::size_t k = 0; k < count; ++k) tasks[first + k].free = packet.tfar[k] >= 0.0f;
  }
}

bool is_hidden(const Scene& scene, const RayScene& rays, const Receivers& receivers, const UnitLight& light,
               std::uint32_t index) {
  const LocalRay local = local_ray(rays.frame(), receivers, index, light.disk().center);
  RTCRayHit ray{};
  ray.ray.org_x = local.from.x, ray.ray.org_y = local.from.y, ray.ray.org_z = local.from.z;
  ray.ray.dir_x = local.way.x, ray.ray.dir_y = local.way.y, ray.ray.dir_z = local.way.z;
  ray.ray.tfar = 1.0f;
  ray.ray.mask = ~0u;
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  ray.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(rays.impl().casters, &context, &ray);
  if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return false;
  const TriangleMesh& mesh = scene.objects[ray.hit.geomID].mesh;
  const IndexedTriangle& t = mesh.triangles()[ray.hit.primID];
  const auto points = mesh.positions();
  Vec3 x = receivers.points[index];
  if (receivers.has_normals()) x += receiver_offset(rays.frame()) * receivers.normals[index];
  return crosses(x, light.disk().center, points[t[0]], points[t[1]], points[t[2]]);
}

}  // namespace penumbra::detail
