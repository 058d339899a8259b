#include "render/center_rays.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "render/ray_scene_impl.h"
#include "render/vector_clones.h"

namespace penumbra {
namespace {

constexpr std::size_t kLanes = 16;

/// Sixteen receivers, local frame.
struct Receivers {
  const float *x, *y, *z, *nx, *ny, *nz;
};

struct LocalDisk {
  float x, y, z;     ///< center
  float mx, my, mz;  ///< unit normal
  float radius;
};

/// Directions to the points aimed at; 0 in `wanted` where no ray is needed.
PENUMBRA_VECTOR_CLONES
void aim(const Receivers& from, const LocalDisk& disk, RTCRay16& packet, int* wanted) {
  for (std::size_t k = 0; k < kLanes; ++k) {
    const float x = disk.x - from.x[k], y = disk.y - from.y[k], z = disk.z - from.z[k];
    const float nx = from.nx[k], ny = from.ny[k], nz = from.nz[k];
    // Up the disk as seen from this horizon: the normal without its part along the light's.
    const float along = nx * disk.mx + ny * disk.my + nz * disk.mz;
    const float ux = nx - along * disk.mx, uy = ny - along * disk.my, uz = nz - along * disk.mz;
    const float size = std::sqrt(ux * ux + uy * uy + uz * uz), reach = disk.radius * size;
    const float height = nx * x + ny * y + nz * z;  // of the center above the horizon
    const bool lifted = height <= 0.0f && height + reach > 0.0f;
    // From the center up to the middle between horizon (-height / size) and top (radius).
    const float lift = lifted ? 0.5f * (disk.radius - height / size) / size : 0.0f;
    packet.dir_x[k] = x + lift * ux;
    packet.dir_y[k] = y + lift * uy;
    packet.dir_z[k] = z + lift * uz;
    const float behind = x * disk.mx + y * disk.my + z * disk.mz;
    wanted[k] = (height > 0.0f || lifted) && behind < 0.0f ? -1 : 0;
  }
}

}  // namespace

CenterRays::CenterRays(const SurfaceBuffer& surface, const RayScene& rays)
    : rays_(rays), pixels_(surface.size()) {
  const auto count = static_cast<std::size_t>(
      std::count_if(surface.object.begin(), surface.object.end(), [](int object) { return object >= 0; }));
  const std::size_t padded = (count + kLanes - 1) / kLanes * kLanes;
  for (auto* list : {&x_, &y_, &z_, &nx_, &ny_, &nz_}) list->assign(padded, 0.0f);
  pixel_.reserve(count);
  for (std::uint32_t i = 0; i < surface.size(); ++i) {
    if (!surface.hit(i)) continue;
    const Vec3& n = surface.normal[i];
    const glm::vec3 p(rays.frame().to_local(surface.position[i]) + kRayOffset * n);
    const std::size_t k = pixel_.size();
    x_[k] = p.x, y_[k] = p.y, z_[k] = p.z;
    nx_[k] = static_cast<float>(n.x), ny_[k] = static_cast<float>(n.y), nz_[k] = static_cast<float>(n.z);
    pixel_.push_back(i);
  }
}

std::vector<std::uint8_t> CenterRays::hidden(const DiskLight& light) const {
  std::vector<std::uint8_t> out(pixels_, 0);
  const RayFrame& frame = rays_.frame();
  const glm::vec3 center(frame.to_local(light.center)), normal(light_frame(light).w);
  const LocalDisk disk{center.x, center.y, center.z, normal.x,
                       normal.y, normal.z, static_cast<float>(light.radius * frame.scale)};
  const auto trace = [&](const tbb::blocked_range<std::size_t>& packets) {
    alignas(64) RTCRay16 packet{};
    alignas(64) int wanted[kLanes];
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    for (std::size_t p = packets.begin(); p < packets.end(); ++p) {
      const std::size_t first = p * kLanes, count = std::min(kLanes, pixel_.size() - first);
      aim({&x_[first], &y_[first], &z_[first], &nx_[first], &ny_[first], &nz_[first]}, disk, packet, wanted);
      for (std::size_t k = 0; k < kLanes; ++k) {
        if (k >= count) wanted[k] = 0;
        packet.org_x[k] = x_[first + k], packet.org_y[k] = y_[first + k], packet.org_z[k] = z_[first + k];
        packet.tnear[k] = 0.0f, packet.tfar[k] = 1.0f, packet.mask[k] = ~0u;
      }
      rtcOccluded16(wanted, rays_.impl().casters, &context, &packet);
      for (std::size_t k = 0; k < count; ++k)
        out[pixel_[first + k]] = wanted[k] && packet.tfar[k] < 0.0f;  // Embree sets it to -infinity at a hit
    }
  };
  rays_.impl().arena.execute([&] {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, x_.size() / kLanes, 64), trace);
  });
  return out;
}

}  // namespace penumbra
