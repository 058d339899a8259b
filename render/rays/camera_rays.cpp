#include "render/rays/camera_rays.h"

#include <tbb/parallel_for.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "mesh/vectors.h"
#include "render/rays/ray_scene_impl.h"

namespace penumbra {
namespace {

constexpr int kLanes = 16;

/// The faces seen through up to 16 neighboring pixels of a row.
void trace_row_part(const RayScene& rays, const PixelRays& pixels, int x0, int y, int count,
                    RTCRayHit16& packet, int* valid) {
  const RayFrame& frame = rays.frame();
  const Vec3 origin = frame.to_local(pixels.origin);
  for (int i = 0; i < kLanes; ++i) {
    valid[i] = i < count ? -1 : 0;
    const Vec3 d = glm::normalize(pixels.direction(x0 + std::min(i, count - 1) + 0.5, y + 0.5));
    packet.ray.org_x[i] = static_cast<float>(origin.x);
    packet.ray.org_y[i] = static_cast<float>(origin.y);
    packet.ray.org_z[i] = static_cast<float>(origin.z);
    packet.ray.dir_x[i] = static_cast<float>(d.x);
    packet.ray.dir_y[i] = static_cast<float>(d.y);
    packet.ray.dir_z[i] = static_cast<float>(d.z);
    packet.ray.tnear[i] = 0.0f;
    packet.ray.tfar[i] = std::numeric_limits<float>::infinity();
    packet.ray.time[i] = 0.0f;
    packet.ray.mask[i] = ~0u;
    packet.ray.flags[i] = 0;
    packet.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    packet.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
  }
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcIntersect16(valid, rays.impl().all, &context, &packet);
}

/// Point and normal of pixel (x, y), in double, from the pixel's ray and the face's plane.
void place(const Scene& scene, const PixelRays& pixels, int x, int y, std::size_t pixel,
           float embree_distance, double scale, SurfaceBuffer& out) {
  const TriangleMesh& mesh = scene.objects[static_cast<std::size_t>(out.object[pixel])].mesh;
  const IndexedTriangle& t = mesh.triangles()[out.face[pixel]];
  const auto points = mesh.positions();
  const Vec3 a = points[t[0]];
  Vec3 normal = detail::unit(glm::cross(points[t[1]] - a, points[t[2]] - a));
  const Vec3 direction = pixels.direction(x + 0.5, y + 0.5);
  const double slope = glm::dot(normal, direction);
  const double traced = embree_distance / (scale * glm::length(direction));
  double distance = slope != 0.0 ? glm::dot(normal, a - pixels.origin) / slope : traced;
  // A face seen edge-on has no well-placed plane point: the double hit may run far off the face.
  if (!(std::abs(distance - traced) <= 1e-3 * traced)) distance = traced;
  out.position[pixel] = pixels.origin + distance * direction;
  out.normal[pixel] = slope > 0.0 ? -normal : normal;
}

}  // namespace

SurfaceBuffer make_surface_buffer(const Scene& scene, const RayScene& rays, int width, int height) {
  if (width <= 0 || height <= 0 || width > 65536 || height > 65536)
    throw UsageError("image size " + std::to_string(width) + "x" + std::to_string(height) +
                     " is outside 1x1 to 65536x65536");
  SurfaceBuffer out;
  out.width = width;
  out.height = height;
  out.revision = new_revision();
  const std::size_t n = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  out.object.assign(n, -1);
  out.face.assign(n, 0);
  out.position.assign(n, Vec3{0.0});
  out.normal.assign(n, Vec3{0.0});
  const PixelRays pixels(scene.camera, width, height);
  rays.arena().execute([&] {
    tbb::parallel_for(0, height, [&](int y) {
      alignas(64) RTCRayHit16 packet;
      alignas(64) int valid[kLanes];
      for (int x0 = 0; x0 < width; x0 += kLanes) {
        const int count = std::min(kLanes, width - x0);
        trace_row_part(rays, pixels, x0, y, count, packet, valid);
        for (int i = 0; i < count; ++i) {
          if (packet.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID) continue;
          const std::size_t pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                                    static_cast<std::size_t>(x0 + i);
          out.object[pixel] = static_cast<std::int32_t>(packet.hit.geomID[i]);
          out.face[pixel] = packet.hit.primID[i];
          place(scene, pixels, x0 + i, y, pixel, packet.ray.tfar[i], rays.frame().scale, out);
        }
      }
    });
  });
  return out;
}

}  // namespace penumbra
