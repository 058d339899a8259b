#include "render/rays/reference.h"

#include <atomic>
#include <chrono>
#include <glm/geometric.hpp>

#include "render/light/area_light.h"
#include "render/light/disk_samples.h"
#include "render/rays/hard.h"
#include "render/rays/ray_methods.h"
#include "render/rays/ray_scene_impl.h"
#include "render/rays/ray_start.h"
#include "render/support/vector_clones.h"

namespace penumbra {
namespace {

constexpr int kLanes = 16;

/// Where each sample's stratum lies, so that no lane divides.
struct StratumTable {
  explicit StratumTable(int samples) : strata(samples) {
    const int padded = (strata.count() + kLanes - 1) / kLanes * kLanes;
    for (int i = 0; i < padded; ++i) {
      const int column = i % strata.columns, row = i / strata.columns;
      columns.push_back(static_cast<float>(column));
      rows.push_back(static_cast<float>(row));
    }
  }
  detail::Strata strata;
  std::vector<float> columns, rows;
};

/// The light in the rays' frame, float.
struct LocalLight {
  glm::vec3 center, u, v;  ///< u and v are half axes of the disk or the rectangle
  bool disk;
  glm::vec3 normal;
};

LocalLight local_light(const AreaLight& light, const RayFrame& frame) {
  return {glm::vec3(frame.to_local(light.center)), glm::vec3(light.axes.u * (light.half.x * frame.scale)),
          glm::vec3(light.axes.v * (light.half.y * frame.scale)), light.disk, glm::vec3(light.axes.w)};
}

/// Sixteen directions from a receiver to disk samples, and which of them are above its horizon.
struct Aim {
  alignas(64) float x[kLanes], y[kLanes], z[kLanes];
  alignas(64) int above[kLanes];
};

PENUMBRA_VECTOR_CLONES
void aim_at_samples(const detail::RayStart& from, const LocalLight& light, const StratumTable& table,
                    std::uint32_t key, int first, Aim& out) {
  const float per_column = 1.0f / static_cast<float>(table.strata.columns);
  const float per_row = 1.0f / static_cast<float>(table.strata.rows);
  const glm::vec3 base = light.center - from.origin, u = light.u, v = light.v, n = from.normal;
  const float* columns = table.columns.data() + first;
  const float* rows = table.rows.data() + first;
  alignas(64) float a[kLanes], b[kLanes];
  for (int k = 0; k < kLanes; ++k) {
    const detail::DiskPoint p = detail::stratum_sample(key, static_cast<std::uint32_t>(first + k), columns[k],
                                                       rows[k], per_column, per_row);
    a[k] = p.x;
    b[k] = p.y;
  }
  if (light.disk)
    for (int k = 0; k < kLanes; ++k) {
      const detail::DiskPoint p = detail::concentric_disk(a[k], b[k]);
      a[k] = p.x;
      b[k] = p.y;
    }
  else
    for (int k = 0; k < kLanes; ++k) {
      a[k] = 2.0f * a[k] - 1.0f;
      b[k] = 2.0f * b[k] - 1.0f;
    }
  for (int k = 0; k < kLanes; ++k) {
    out.x[k] = base.x + u.x * a[k] + v.x * b[k];
    out.y[k] = base.y + u.y * a[k] + v.y * b[k];
    out.z[k] = base.z + u.z * a[k] + v.z * b[k];
    out.above[k] = n.x * out.x[k] + n.y * out.y[k] + n.z * out.z[k] > 0.0f ? -1 : 0;
  }
}

/// What does not change from packet to packet of one receiver.
void start_packet(const detail::RayStart& x, RTCRay16& packet) {
  for (int k = 0; k < kLanes; ++k) {
    packet.org_x[k] = x.origin.x;
    packet.org_y[k] = x.origin.y;
    packet.org_z[k] = x.origin.z;
    packet.tnear[k] = 0.0f;
    packet.time[k] = 0.0f;
    packet.mask[k] = ~0u;
    packet.id[k] = 0;
    packet.flags[k] = 0;
  }
}

struct RayCounts {
  int visible = 0;    ///< unblocked and above the horizon
  int unblocked = 0;  ///< unblocked
  std::size_t rays = 0;
};

/// The packet's rays one by one, as a plain use of Embree would trace them.
void trace_singly(const RayScene& rays, const int* valid, RTCIntersectContext& context, RTCRay16& packet) {
  for (int k = 0; k < kLanes; ++k) {
    if (!valid[k]) continue;
    RTCRay ray{};
    ray.org_x = packet.org_x[k], ray.org_y = packet.org_y[k], ray.org_z = packet.org_z[k];
    ray.dir_x = packet.dir_x[k], ray.dir_y = packet.dir_y[k], ray.dir_z = packet.dir_z[k];
    ray.tfar = packet.tfar[k];
    ray.mask = packet.mask[k];
    rtcOccluded1(rays.impl().casters, &context, &ray);
    packet.tfar[k] = ray.tfar;
  }
}

/// `all`: also trace what is below the horizon, for the unblocked count.
RayCounts trace_receiver(const RayScene& rays, const detail::RayStart& x, const LocalLight& light,
                         const StratumTable& table, std::uint32_t key, bool all, bool packets) {
  RayCounts counts;
  Aim aim;
  alignas(64) RTCRay16 packet;
  alignas(64) int valid[kLanes];
  start_packet(x, packet);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  const float end = ray_end(glm::dot(x.origin - light.center, light.normal));
  for (int first = 0; first < table.strata.count(); first += kLanes) {
    aim_at_samples(x, light, table, key, first, aim);
    const int count = std::min(kLanes, table.strata.count() - first);
    int lanes = 0;
    for (int k = 0; k < kLanes; ++k) {
      valid[k] = k < count && (all || aim.above[k]) ? -1 : 0;
      lanes -= valid[k];
      packet.dir_x[k] = aim.x[k];
      packet.dir_y[k] = aim.y[k];
      packet.dir_z[k] = aim.z[k];
      packet.tfar[k] = end;
    }
    if (lanes == 0) continue;
    counts.rays += static_cast<std::size_t>(lanes);
    if (packets)
      rtcOccluded16(valid, rays.impl().casters, &context, &packet);
    else
      trace_singly(rays, valid, context, packet);
    for (int k = 0; k < kLanes; ++k) {
      const int open =
          valid[k] & (packet.tfar[k] >= 0.0f ? -1 : 0);  // Embree sets tfar to -infinity at a hit
      counts.visible -= open & aim.above[k];
      counts.unblocked -= open;
    }
  }
  return counts;
}

std::uint32_t key_of(const Receivers& receivers, std::uint32_t i, std::uint64_t seed) {
  if (receivers.are_pixels()) return detail::sample_key(seed, i);
  return detail::sample_key(seed, receivers.points[i]);
}

}  // namespace

ReferenceResult trace_reference(const RayScene& rays, const LightShape& shape, const Receivers& receivers,
                                std::span<const std::uint32_t> indices, const ReferenceOptions& options,
                                bool with_unoccluded, const Progress& progress) {
  require_allowed(sampling_options(), "samples", static_cast<std::uint64_t>(options.samples));
  if (is_point(shape)) {
    ReferenceResult hard = trace_hard(rays, shape, receivers, indices);
    if (with_unoccluded) hard.unoccluded = trace_hard(rays, shape, receivers, indices, false).visibility;
    return hard;
  }
  const auto start = std::chrono::steady_clock::now();
  const StratumTable table(options.samples);
  const LocalLight light = local_light(area_light(shape), rays.frame());
  const DiskLight plane = disk_around(shape);
  ReferenceResult out;
  out.samples = table.strata.count();
  out.visibility.assign(indices.size(), 1.0f);
  if (with_unoccluded) out.unoccluded.assign(indices.size(), 1.0f);
  std::atomic<std::size_t> traced{0};
  const float per_sample = 1.0f / static_cast<float>(table.strata.count());
  const bool all = with_unoccluded || !receivers.has_normals();
  detail::for_each_receiver(rays.arena(), indices.size(), progress, [&](std::size_t i) {
    const std::uint32_t receiver = indices[i];
    if (!receivers.is_present(receiver)) return;
    if (is_behind(plane, receivers.points[receiver])) {
      out.visibility[i] = 0.0f;
      if (with_unoccluded) out.unoccluded[i] = 0.0f;
      return;
    }
    const RayCounts counts =
        trace_receiver(rays, detail::ray_start(receivers, receiver, rays.frame()), light, table,
                       key_of(receivers, receiver, options.seed), all, options.packets);
    const int visible = receivers.has_normals() ? counts.visible : counts.unblocked;
    out.visibility[i] = static_cast<float>(visible) * per_sample;
    if (with_unoccluded) out.unoccluded[i] = static_cast<float>(counts.unblocked) * per_sample;
    traced += counts.rays;
  });
  out.rays = traced;
  out.milliseconds =
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  return out;
}

}  // namespace penumbra
