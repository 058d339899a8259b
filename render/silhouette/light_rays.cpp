#include "render/silhouette/light_rays.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "mesh/vectors.h"
#include "penumbra/volumes/predicates/predicates.h"
#include "render/rays/ray_packets.h"

namespace penumbra::detail {
namespace {

/// To a point `depth` before the light; `aim`: of the unit disk.
Ray ray_to(const UnitLight& light, double depth, const glm::dvec2& aim, const Receivers& receivers,
           std::uint32_t index) {
  const CircularLight& disk = light.light();
  const RayStart from = start_of(receivers, index);
  const Vec3 normal = unit(disk.normal);
  const Vec3 to_center = disk.is_distant() ? -normal : disk.center + depth * normal - from.point;
  return {from, to_center + light.offset_on_disk(aim), disk.is_distant()};
}

/// The open segment p q passes through the inside of triangle (a, b, c).
bool crosses(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Sign before = orient3d(a, b, c, p), after = orient3d(a, b, c, q);
  if (before == Sign::kZero || after == Sign::kZero || before == after) return false;
  const Sign side = orient3d(p, q, a, b);
  return side != Sign::kZero && orient3d(p, q, b, c) == side && orient3d(p, q, c, a) == side;
}

}  // namespace

void trace_tasks(const RayScene& rays, const Receivers& receivers, const UnitLight& light, double depth,
                 std::span<RayTask> tasks) {
  constexpr std::size_t kRays = RayPacket::kRays;
  RayPacket packet;
  packet.endless = light.light().is_distant();
  for (std::size_t first = 0; first < tasks.size(); first += kRays) {
    const std::size_t count = std::min(kRays, tasks.size() - first);
    for (std::size_t k = 0; k < kRays; ++k) {
      const RayTask& task = tasks[first + std::min(k, count - 1)];
      packet.wanted[k] = k < count ? -1 : 0;
      packet.set(k, ray_to(light, depth, task.aim, receivers, task.index));
    }
    find_occluded(rays, packet, Coherence::kCoherent);
    for (std::size_t k = 0; k < count; ++k) tasks[first + k].free = !packet.is_occluded(k);
  }
}

bool is_hidden(const Scene& scene, const RayScene& rays, const Receivers& receivers, const UnitLight& light,
               double depth, std::uint32_t index) {
  const Ray ray = ray_to(light, depth, glm::dvec2(0.0), receivers, index);
  const std::optional<RayHit> hit = first_hit(rays, ray);
  if (!hit) return false;
  const TriangleMesh& mesh = scene.objects[hit->object].mesh;
  const IndexedTriangle& t = mesh.triangles()[hit->face];
  const auto points = mesh.positions();
  const Vec3& x = ray.from.point;
  const Vec3 end = ray.endless ? x + 2.0 * hit->distance * ray.way : x + ray.way;
  return crosses(x, end, points[t[0]], points[t[1]], points[t[2]]);
}

}  // namespace penumbra::detail
