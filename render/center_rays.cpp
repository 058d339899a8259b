#include "render/center_rays.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "render/disk_area.h"
#include "render/ray_scene_impl.h"
#include "render/vector_clones.h"

namespace penumbra {

/// Sixteen receivers, local frame.
struct detail::ReceiverLanes {
  const float *x, *y, *z, *nx, *ny, *nz;
};

namespace {

using detail::ReceiverLanes;

constexpr std::size_t kLanes = 16;
constexpr int kBlock = 4;  // pixels a side that share a packet
/// What a cut reads as that only the ray towards the light finds: the two directions round differently.
constexpr float kAlmostThere = 1.0f - 0x1p-20f;

struct LocalDisk {
  float x, y, z;     ///< center
  float mx, my, mz;  ///< unit normal
  float radius;
};

LocalDisk local_disk(const DiskLight& light, const RayFrame& frame) {
  const glm::vec3 center(frame.to_local(light.center)), m(light_frame(light).w);
  return {center.x, center.y, center.z, m.x, m.y, m.z, static_cast<float>(light.radius * frame.scale)};
}

/// Directions to the points aimed at; 0 in `wanted` where no ray is needed.
PENUMBRA_VECTOR_CLONES
void aim(const ReceiverLanes& from, const LocalDisk& disk, RTCRay16& packet, int* wanted) {
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

/// The chord that each horizon cuts off the disk, as its signed distance from the center in radii: 1 and more
/// where all of the disk is above, -1 behind the light. Heights are of the surface, not of the rays' origins.
PENUMBRA_VECTOR_CLONES
void horizon_chords(const ReceiverLanes& from, const LocalDisk& disk, float* delta) {
  constexpr float kOffset = static_cast<float>(kRayOffset);
  for (std::size_t k = 0; k < kLanes; ++k) {
    const float x = disk.x - from.x[k], y = disk.y - from.y[k], z = disk.z - from.z[k];
    const float nx = from.nx[k], ny = from.ny[k], nz = from.nz[k];
    const float along = nx * disk.mx + ny * disk.my + nz * disk.mz;
    const float ux = nx - along * disk.mx, uy = ny - along * disk.my, uz = nz - along * disk.mz;
    const float reach = disk.radius * std::sqrt(ux * ux + uy * uy + uz * uz);
    const float height = nx * x + ny * y + nz * z + kOffset;
    const float behind = x * disk.mx + y * disk.my + z * disk.mz;
    const float inside = height / std::max(reach, 1e-30f);
    delta[k] = behind >= 0.0f ? -1.0f : height >= reach ? 1.0f : inside;
  }
}

/// Sixteen rays, first from receivers to see whether anything is in the way, then back for what the light
/// meets first.
struct Packet {
  alignas(64) RTCRayHit16 hits{};
  alignas(64) int wanted[kLanes];
  RTCIntersectContext context;

  Packet() {
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  }

  /// Leaves in `wanted` the lanes that are cut, and where in the ray's tfar: 0 at the light, 1 at the
  /// receiver.
  void find_first_cuts(const ReceiverLanes& from, RTCScene casters) {
    RTCRay16& ray = hits.ray;
    for (std::size_t k = 0; k < kLanes; ++k) {
      ray.org_x[k] = from.x[k], ray.org_y[k] = from.y[k], ray.org_z[k] = from.z[k];
      ray.tnear[k] = 0.0f, ray.tfar[k] = 1.0f, ray.mask[k] = ~0u;
    }
    rtcOccluded16(wanted, casters, &context, &ray);
    bool any = false;
    for (std::size_t k = 0; k < kLanes; ++k) {
      wanted[k] = wanted[k] && ray.tfar[k] < 0.0f ? -1 : 0;  // Embree sets it to -infinity at a hit
      any = any || wanted[k];
      ray.org_x[k] += ray.dir_x[k], ray.org_y[k] += ray.dir_y[k], ray.org_z[k] += ray.dir_z[k];
      ray.dir_x[k] = -ray.dir_x[k], ray.dir_y[k] = -ray.dir_y[k], ray.dir_z[k] = -ray.dir_z[k];
      ray.tfar[k] = kAlmostThere;
      hits.hit.geomID[k] = RTC_INVALID_GEOMETRY_ID;
    }
    if (any) rtcIntersect16(wanted, casters, &context, &hits);
  }
};

}  // namespace

CenterRays::CenterRays(const SurfaceBuffer& surface, const RayScene& rays)
    : rays_(rays), pixels_(surface.size()) {
  const auto count = static_cast<std::size_t>(
      std::count_if(surface.object.begin(), surface.object.end(), [](int object) { return object >= 0; }));
  const std::size_t padded = (count + kLanes - 1) / kLanes * kLanes;
  for (auto* list : {&x_, &y_, &z_, &nx_, &ny_, &nz_}) list->assign(padded, 0.0f);
  pixel_.reserve(count);
  const auto add = [&](std::uint32_t i) {
    if (!surface.hit(i)) return;
    const Vec3& n = surface.normal[i];
    const glm::vec3 p(rays.frame().to_local(surface.position[i]) + kRayOffset * n);
    const std::size_t k = pixel_.size();
    x_[k] = p.x, y_[k] = p.y, z_[k] = p.z;
    nx_[k] = static_cast<float>(n.x), ny_[k] = static_cast<float>(n.y), nz_[k] = static_cast<float>(n.z);
    pixel_.push_back(i);
  };
  for (int top = 0; top < surface.height; top += kBlock)
    for (int left = 0; left < surface.width; left += kBlock)
      for (int y = top; y < std::min(top + kBlock, surface.height); ++y)
        for (int x = left; x < std::min(left + kBlock, surface.width); ++x)
          add(static_cast<std::uint32_t>(y * surface.width + x));
}

detail::ReceiverLanes CenterRays::lanes(std::size_t first) const {
  return {&x_[first], &y_[first], &z_[first], &nx_[first], &ny_[first], &nz_[first]};
}

std::vector<float> CenterRays::above_horizon(const DiskLight& light) const {
  std::vector<float> out(pixels_, 1.0f);
  const LocalDisk disk = local_disk(light, rays_.frame());
  const auto look = [&](const tbb::blocked_range<std::size_t>& packets) {
    float delta[kLanes];
    for (std::size_t p = packets.begin(); p < packets.end(); ++p) {
      const std::size_t first = p * kLanes, count = std::min(kLanes, pixel_.size() - first);
      horizon_chords(lanes(first), disk, delta);
      for (std::size_t k = 0; k < count; ++k)
        out[pixel_[first + k]] = delta[k] >= 1.0f   ? 1.0f
                                 : delta[k] > -1.0f ? static_cast<float>(half_plane_area(delta[k]))
                                                    : 0.0f;
    }
  };
  rays_.impl().arena.execute(
      [&] { tbb::parallel_for(tbb::blocked_range<std::size_t>(0, x_.size() / kLanes, 256), look); });
  return out;
}

std::vector<float> CenterRays::first_cut(const DiskLight& light) const {
  std::vector<float> out(pixels_, 1.0f);
  const LocalDisk disk = local_disk(light, rays_.frame());
  const auto trace = [&](const tbb::blocked_range<std::size_t>& packets) {
    Packet packet;
    for (std::size_t p = packets.begin(); p < packets.end(); ++p) {
      const std::size_t first = p * kLanes, count = std::min(kLanes, pixel_.size() - first);
      const ReceiverLanes from = lanes(first);
      aim(from, disk, packet.hits.ray, packet.wanted);
      for (std::size_t k = count; k < kLanes; ++k) packet.wanted[k] = 0;
      packet.find_first_cuts(from, rays_.impl().casters);
      for (std::size_t k = 0; k < count; ++k)
        if (packet.wanted[k]) out[pixel_[first + k]] = packet.hits.ray.tfar[k];
    }
  };
  rays_.impl().arena.execute(
      [&] { tbb::parallel_for(tbb::blocked_range<std::size_t>(0, x_.size() / kLanes, 64), trace); });
  return out;
}

namespace {

/// Points of the disk that are asked in turn, in radii: three across what lies beyond a chord whose middle is
/// `aim`, and three round the rest.
std::array<glm::vec2, 6> places_to_ask(const glm::vec2& aim) {
  const float size = glm::length(aim);
  const glm::vec2 to = aim / std::max(size, 1e-6f), across(-to.y, to.x);
  const float half = 0.6f * std::sqrt(std::max(0.0f, 1.0f - size * size)), rest = 0.75f;
  return {aim, aim + half * across, aim - half * across, -rest * to, rest * across, -rest * across};
}

}  // namespace

std::vector<char> CenterRays::refuted(const DiskLight& light, std::span<const glm::vec2> aims,
                                      std::span<const float> cuts) const {
  std::vector<char> out(pixels_, 0);
  const RayFrame& frame = rays_.frame();
  const LightFrame axes = light_frame(light);
  const double radius = light.radius * frame.scale;
  const glm::vec3 center(frame.to_local(light.center)), u(radius * axes.u), v(radius * axes.v);
  const auto ask = [&](std::span<const std::uint32_t> lanes) {
    std::array<glm::vec2, 6> places[kLanes];
    alignas(64) int open[kLanes] = {};  // -1: nothing speaks for the entry yet
    for (std::size_t lane = 0; lane < lanes.size(); ++lane) {
      places[lane] = places_to_ask(aims[pixel_[lanes[lane]]]);
      open[lane] = -1;
    }
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    for (std::size_t turn = 0; turn < places[0].size(); ++turn) {
      alignas(64) RTCRay16 ray{};
      alignas(64) int wanted[kLanes] = {};
      for (std::size_t lane = 0; lane < lanes.size(); ++lane) {
        const std::uint32_t k = lanes[lane];
        const glm::vec2 at = places[lane][turn];
        const glm::vec3 from(x_[k], y_[k], z_[k]), way = center + at.x * u + at.y * v - from;
        ray.org_x[lane] = from.x, ray.org_y[lane] = from.y, ray.org_z[lane] = from.z;
        ray.dir_x[lane] = way.x, ray.dir_y[lane] = way.y, ray.dir_z[lane] = way.z;
        ray.tfar[lane] = 1.0f, ray.mask[lane] = ~0u;
        // What is below the horizon says nothing.
        const bool above = way.x * nx_[k] + way.y * ny_[k] + way.z * nz_[k] > 0.0f;
        wanted[lane] = open[lane] && above ? -1 : 0;
      }
      rtcOccluded16(wanted, rays_.impl().casters, &context, &ray);
      bool any = false;
      for (std::size_t lane = 0; lane < lanes.size(); ++lane) {
        const bool blocked = ray.tfar[lane] < 0.0f, hidden = cuts[pixel_[lanes[lane]]] < 1.0f;
        if (wanted[lane] && blocked != hidden) open[lane] = 0;
        any = any || open[lane];
      }
      if (!any) break;
    }
    for (std::size_t lane = 0; lane < lanes.size(); ++lane) out[pixel_[lanes[lane]]] = open[lane] != 0;
  };
  const auto ask_in = [&](const tbb::blocked_range<std::size_t>& places) {
    std::array<std::uint32_t, kLanes> lanes;  // places in pixel_
    std::size_t count = 0;
    for (std::size_t k = places.begin(); k < places.end(); ++k) {
      if (glm::length(aims[pixel_[k]]) > 1.0f) continue;
      lanes[count++] = static_cast<std::uint32_t>(k);
      if (count == kLanes) ask(std::span(lanes)), count = 0;
    }
    if (count > 0) ask(std::span(lanes).first(count));
  };
  rays_.impl().arena.execute(
      [&] { tbb::parallel_for(tbb::blocked_range<std::size_t>(0, pixel_.size(), 4096), ask_in); });
  return out;
}

}  // namespace penumbra
