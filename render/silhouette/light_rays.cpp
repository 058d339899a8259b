#include "render/silhouette/light_rays.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "mesh/vectors.h"
#include "penumbra/volumes/predicates/predicates.h"
#include "render/rays/ray_packets.h"
#include "render/rays/ray_start.h"

namespace penumbra::detail {
namespace {

constexpr float kStepBack = 0.8f * static_cast<float>(kRayOffset);

struct LocalRay {
  glm::vec3 from, way;
};

/// `aim`: a point of the unit disk.
LocalRay local_ray(const RayFrame& frame, const Receivers& receivers, std::uint32_t index,
                   const UnitLight& light, const glm::dvec2& aim) {
  const glm::vec3 from = ray_start(receivers, index, frame).origin;
  const CircularLight& disk = light.light();
  if (!disk.is_distant())
    return {from, glm::vec3(frame.to_local(disk.center + light.offset_on_disk(aim))) - from};
  constexpr float kBeyondCasters = 4.0f;
  const Vec3 way = light.offset_on_disk(aim) - unit(disk.normal);
  return {from, (kBeyondCasters + glm::length(from)) * glm::vec3(way)};
}

void set_ray(const RayTask& task, const RayFrame& frame, const Receivers& receivers, const UnitLight& light,
             std::size_t k, RayPacket& packet) {
  LocalRay ray = local_ray(frame, receivers, task.index, light, task.aim);
  if (task.step_back) {
    const glm::vec3 step = (kStepBack / glm::length(ray.way)) * ray.way;
    ray.from -= step, ray.way += step;
  }
  packet.from_x[k] = ray.from.x, packet.from_y[k] = ray.from.y, packet.from_z[k] = ray.from.z;
  packet.way_x[k] = ray.way.x, packet.way_y[k] = ray.way.y, packet.way_z[k] = ray.way.z;
  packet.end[k] = ray_end(-glm::dot(ray.way, glm::vec3(light.world_direction({0.0, 0.0, 1.0}))));
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
  const LocalRay ray = local_ray(rays.frame(), receivers, index, light, glm::dvec2(0.0));
  const std::optional<RayHit> hit = first_hit(rays, ray.from, ray.way, 1.0f);
  if (!hit) return false;
  const TriangleMesh& mesh = scene.objects[hit->object].mesh;
  const IndexedTriangle& t = mesh.triangles()[hit->face];
  const auto points = mesh.positions();
  const Vec3& x = receivers.points[index];
  const Vec3 end = light.light().is_distant() ? x + Vec3(ray.way) / rays.frame().scale : light.light().center;
  return crosses(x, end, points[t[0]], points[t[1]], points[t[2]]);
}

}  // namespace penumbra::detail
