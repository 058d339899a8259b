#include "render/rays/hard.h"

#include <atomic>
#include <chrono>
#include <glm/geometric.hpp>

#include "render/rays/ray_scene_impl.h"
#include "render/rays/ray_start.h"

namespace penumbra {

ReferenceResult trace_hard(const RayScene& rays, const LightShape& light, const Receivers& receivers,
                           std::span<const std::uint32_t> indices, bool horizon) {
  const auto start = std::chrono::steady_clock::now();
  const DiskLight disk = disk_around(light);
  const glm::vec3 center(rays.frame().to_local(disk.center)), normal(light_frame(disk).w);
  ReferenceResult out;
  out.visibility.assign(indices.size(), 1.0f);
  std::atomic<std::size_t> traced{0};
  detail::for_each_receiver(rays.arena(), indices.size(), {}, [&](std::size_t i) {
    const std::uint32_t receiver = indices[i];
    if (!receivers.is_present(receiver)) return;
    const detail::RayStart x = detail::ray_start(receivers, receiver, rays.frame());
    const glm::vec3 d = center - x.origin;
    const bool below = horizon && receivers.has_normals() && glm::dot(x.normal, d) <= 0.0f;
    if (is_behind(disk, receivers.points[receiver]) || below) {
      out.visibility[i] = 0.0f;
      return;
    }
    RTCRay ray{};
    ray.org_x = x.origin.x, ray.org_y = x.origin.y, ray.org_z = x.origin.z;
    ray.dir_x = d.x, ray.dir_y = d.y, ray.dir_z = d.z;
    ray.tfar = ray_end(-glm::dot(d, normal));
    ray.mask = ~0u;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded1(rays.impl().casters, &context, &ray);
    out.visibility[i] = ray.tfar >= 0.0f ? 1.0f : 0.0f;
    ++traced;
  });
  out.rays = traced;
  out.milliseconds =
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  return out;
}

}  // namespace penumbra
