#include "render/silhouette_rays.h"

#include <algorithm>

#include "render/ray_scene_impl.h"

namespace penumbra::detail {
namespace {

constexpr std::size_t kLanes = 16;

void set_lane(const RayTask& task, const RayFrame& frame, const SurfaceBuffer& surface,
              const UnitLight& light, std::size_t k, RTCRay16& packet) {
  const glm::vec3 from(frame.to_local(surface.position[task.pixel]) +
                       kRayOffset * surface.normal[task.pixel]);
  const glm::vec3 way = glm::vec3(frame.to_local(light.world_on_disk(task.aim))) - from;
  packet.org_x[k] = from.x, packet.org_y[k] = from.y, packet.org_z[k] = from.z;
  packet.dir_x[k] = way.x, packet.dir_y[k] = way.y, packet.dir_z[k] = way.z;
  packet.tnear[k] = 0.0f, packet.tfar[k] = 1.0f, packet.time[k] = 0.0f;
  packet.mask[k] = ~0u, packet.id[k] = 0, packet.flags[k] = 0;
}

}  // namespace

double receiver_offset(const RayFrame& frame) {
  return kRayOffset / frame.scale;
}

void trace_tasks(const RayScene& rays, const SurfaceBuffer& surface, const UnitLight& light,
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
      set_lane(tasks[first + std::min(k, count - 1)], rays.frame(), surface, light, k, packet);
    }
    rtcOccluded16(valid, rays.impl().casters, &context, &packet);
    // Embree sets tfar to -infinity at a hit.
    for (std::size_t k = 0; k < count; ++k) tasks[first + k].free = packet.tfar[k] >= 0.0f;
  }
}

}  // namespace penumbra::detail
