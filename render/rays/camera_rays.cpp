#include "render/rays/camera_rays.h"

#include <tbb/parallel_invoke.h>

#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

#include "mesh/vectors.h"
#include "render/rays/each_receiver.h"
#include "render/rays/hit_filter.h"

namespace penumbra {
namespace {

using detail::GroupRays;
using detail::NearestHit;
using detail::RayPacket;

constexpr int kLanes = RayPacket::kRays;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// What one pixel's ray meets first.
struct Seen {
  const detail::RayGeometry* geometry = nullptr;
  std::uint32_t face = 0;
  double distance = kInfinity;
};

/// The faces seen through up to 16 neighboring pixels of a row.
void trace_row_part(const RayScene& rays, const PixelRays& pixels, const PointInPixel& at, int x0, int y,
                    int count, RayPacket& packet, GroupRays& of_group, Seen* out) {
  for (int i = 0; i < kLanes; ++i) {
    packet.wanted[i] = i < count ? -1 : 0;
    packet.set_way(i, pixels.direction(x0 + std::min(i, count - 1) + at.x, y + at.y));
    out[i] = {};
  }
  std::array<NearestHit, RayPacket::kRays> nearest;
  for (const auto* groups : {&rays.impl().casters, &rays.impl().others})
    for (const auto& group : *groups) {
      if (!of_group.set(packet, packet.wanted, group->frame)) continue;
      detail::find_nearest(*group, packet, of_group, nearest);
      for (int i = 0; i < count; ++i) {
        if (!nearest[i].geometry) continue;
        const double distance =
            detail::distance_to(*nearest[i].geometry, nearest[i].face, pixels.origin, packet.way(i));
        if (!(distance >= out[i].distance)) out[i] = {nearest[i].geometry, nearest[i].face, distance};
      }
    }
}

Bounds bounds_of(const Vec3& a, const Vec3& b, const Vec3& c) {
  return {glm::min(a, glm::min(b, c)), glm::max(a, glm::max(b, c))};
}

bool is_inside(const Bounds& box, const Vec3& p) {
  const Vec3 size = box.high - box.low;
  const double margin = 0x1p-20 * detail::largest_component(size);
  return glm::all(glm::greaterThanEqual(p, box.low - margin)) &&
         glm::all(glm::lessThanEqual(p, box.high + margin));
}

/// The point of the ray nearest to `distance` that lies in the box; one close to both where the ray misses
/// it.
Vec3 point_in_box(const Bounds& box, const Vec3& origin, const Vec3& direction, double distance) {
  double enter = -kInfinity, leave = kInfinity;
  for (int k = 0; k < 3; ++k) {
    if (direction[k] == 0.0) continue;
    const double a = (box.low[k] - origin[k]) / direction[k], b = (box.high[k] - origin[k]) / direction[k];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  const double first = std::min(enter, leave), last = std::max(enter, leave);
  const double at = std::isfinite(distance) ? std::clamp(distance, first, last) : 0.5 * first + 0.5 * last;
  return glm::clamp(origin + at * direction, box.low, box.high);
}

/// Point and normal of a pixel, in double, from the pixel's ray and the face's plane.
///
/// The point is rounded as its distance from the camera is; put onto the plane once more it misses it by the
/// rounding of n·(p - a), four roundings of every |p - a|, and by that of its own coordinates.
void place(const Vec3& origin, const Vec3& direction, const Seen& seen, std::size_t pixel,
           SurfaceBuffer& out) {
  const TriangleMesh& mesh = seen.geometry->mesh;
  const IndexedTriangle& t = mesh.triangles()[seen.face];
  const auto points = mesh.positions();
  const Vec3 &a = points[t[0]], &b = points[t[1]], &c = points[t[2]];
  const Vec3 normal = detail::unit(glm::cross(b - a, c - a));
  Vec3 point = origin + seen.distance * direction;
  // A face seen edge-on leaves the place in its plane to rounding.
  const Bounds box = bounds_of(a, b, c);
  if (!is_inside(box, point)) point = point_in_box(box, origin, direction, seen.distance);
  out.position[pixel] = point - glm::dot(normal, point - a) * normal;
  out.normal[pixel] = glm::dot(normal, direction) > 0.0 ? -normal : normal;
  out.object[pixel] = static_cast<std::int32_t>(seen.geometry->object);
  out.face[pixel] = seen.face;
}

void place_none(std::size_t pixel, SurfaceBuffer& out) {
  out.position[pixel] = out.normal[pixel] = Vec3(0.0);
  out.object[pixel] = -1;
  out.face[pixel] = 0;
}

}  // namespace

SurfaceBuffer make_surface_buffer(const Scene& scene, const RayScene& rays, int width, int height,
                                  const PointInPixel& at, const Progress& progress, SurfaceBuffer memory) {
  if (width <= 0 || height <= 0 || width > 65536 || height > 65536)
    throw UsageError("image size " + std::to_string(width) + "x" + std::to_string(height) +
                     " is outside 1x1 to 65536x65536");
  SurfaceBuffer out = std::move(memory);
  out.width = width;
  out.height = height;
  out.revision = new_revision();
  const std::size_t n = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  // The system clears memory that it gives away, which takes as long as filling it.
  rays.arena().execute([&] {
    tbb::parallel_invoke([&] { out.position.resize(n); }, [&] { out.normal.resize(n); },
                         [&] { out.object.resize(n), out.face.resize(n); });
  });
  const PixelRays pixels(scene.camera, width, height);
  detail::for_each_block(rays.arena(), static_cast<std::size_t>(height), progress, [&](std::size_t row) {
    const int y = static_cast<int>(row);
    RayPacket packet;
    packet.endless = true;
    for (int i = 0; i < kLanes; ++i) packet.set_start(i, {.point = pixels.origin});
    GroupRays of_group;
    Seen seen[kLanes];
    for (int x0 = 0; x0 < width; x0 += kLanes) {
      const int count = std::min(kLanes, width - x0);
      trace_row_part(rays, pixels, at, x0, y, count, packet, of_group, seen);
      const std::size_t first = row * static_cast<std::size_t>(width) + static_cast<std::size_t>(x0);
      for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i)
        if (seen[i].geometry)
          place(pixels.origin, packet.way(i), seen[i], first + i, out);
        else
          place_none(first + i, out);
    }
  });
  return out;
}

}  // namespace penumbra
