#include "render/silhouette/light_rays.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "penumbra/volumes/predicates/predicates.h"
#include "render/rays/ray_packets.h"
#include "render/rays/ray_start.h"

namespace penumbra::detail {
namespace {

constexpr float kStepBack = 0.8f * static_cast<float>(kRayOffset);

struct LocalRay {
  glm::vec3 from, way;
};

LocalRay local_ray(const RayFrame& frame, const Receivers& receivers, std::uint32_t index, const Vec3& aim) {
  const glm::vec3 from = ray_start(receivers, index, frame).origin;
  return {from, glm::vec3(frame.to_local(aim)) - from};
}

void set_ray(const RayTask& task, const RayFrame& frame, const Receivers& receivers, const UnitLight& light,
             std::size_t k, RayPacket& packet) {
  LocalRay ray = local_ray(frame, receivers, task.index, light.world_on_disk(task.aim));
  if (task.step_back) {
    const glm::vec3 step = (kStepBack / glm::length(ray.way)) * ray.way;
    ray.from -= step, ray.way += step;
  }
  packet.from_x[k] = ray.from.x, packet.from_y[k] = ray.from.y, packet.from_z[k] = ray.from.z;
  packet.way_x[k] = ray.way.x, packet.way_y[k] = ray.way.y, packet.way_z[k] = ray.way.z;
  packet.end[k] = ray_end(-glm::dot(ray.way, glm::vec3(light.normal())));
}

/// The open segment p q passes through the inside of triangle (a, b, c).
bool crosses(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Sign before = orient3d(a, b, c, p), after = orient3d(a, b, c, q);
  if (before == Sign::kZero || after == Sign::kZero || before == after) return false;
  const Sign side = orient3d(p, q, a, b);
  return side != Sign::kZero && orient3d(p, q, b, c) == side && orient3d(p, q, c, a) == side;
}

}  // namespace

void trace_tasks(const RayScene& rays, const Receivers& receivers, const UnitLight& light,
                 std::span<RayTask> tasks) {
  constexpr std::size_t kRays = RayPacket::kRays;
  RayPacket packet;
  for (std::size_t first = 0; first < tasks.size(); first += kRays) {
    const std::size_t count = std::min(kRays, tasks.size() - first);
    for (std::size_t k = 0; k < kRays; ++k) {
      packet.wanted[k] = k < count ? -1 : 0;
      set_ray(tasks[first + std::min(k, count - 1)], rays.frame(), receivers, light, k, packet);
    }
    find_occluded(rays, packet, Coherence::kCoherent);
    for (std::size_t k = 0; k < count; ++k) tasks[first + k].free = !packet.is_occluded(k);
  }
}

bool is_hidden(const Scene& scene, const RayScene& rays, const Receivers& receivers, const UnitLight& light,
               std::uint32_t index) {
  const LocalRay ray = local_ray(rays.frame(), receivers, index, light.disk().center);
  const std::optional<RayHit> hit = first_hit(rays, ray.from, ray.way, 1.0f);
  if (!hit) return false;
  const TriangleMesh& mesh = scene.objects[hit->object].mesh;
  const IndexedTriangle& t = mesh.triangles()[hit->face];
  const auto points = mesh.positions();
  return crosses(receivers.points[index], light.disk().center, points[t[0]], points[t[1]], points[t[2]]);
}

}  // namespace penumbra::detail
