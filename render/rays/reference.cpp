#include "render/rays/reference.h"

#include <atomic>
#include <chrono>
#include <glm/geometric.hpp>

#include "render/light/area_light.h"
#include "render/light/light_samples.h"
#include "render/rays/each_receiver.h"
#include "render/rays/hard.h"
#include "render/rays/ray_methods.h"
#include "render/rays/ray_packets.h"
#include "render/receivers/sample_key.h"
#include "render/support/vector_clones.h"

namespace penumbra {
namespace {

using detail::StratumTable;

constexpr int kLanes = detail::RayPacket::kRays;
static_assert(kLanes == detail::kSampleLanes);

/// Ways from a receiver to sixteen samples of the light, in world coordinates, and which of them are above
/// its horizon.
///
/// Double from the start, relative to the receiver: the light may be at any distance.
struct Aim {
  /// To the light's center; of a distant light the direction towards it.
  Vec3 center;
  /// Half axes of the disk or the rectangle, in the same unit.
  Vec3 u, v;
  bool disk;
  /// The receiver's; 0 where it has none.
  Vec3 normal;

  Aim(const AreaLight& light, const Receivers& receivers, std::size_t receiver)
      : center(light.from_receiver(receivers.points[receiver])),
        u(light.axes.u * light.half.x),
        v(light.axes.v * light.half.y),
        disk(light.disk),
        normal(receivers.has_normals() ? receivers.normals[receiver] : Vec3(0.0)) {}
};

PENUMBRA_VECTOR_CLONES
void aim_at_samples(const Aim& aim, const StratumTable& table, std::uint32_t key, int first,
                    detail::RayPacket& out, int* above) {
  const Vec3 c = aim.center, u = aim.u, v = aim.v, n = aim.normal;
  alignas(64) float a[kLanes], b[kLanes];
  detail::place_samples(table, aim.disk, key, first, a, b);
  alignas(64) double height[kLanes];
  for (int k = 0; k < kLanes; ++k) {
    const double s = a[k], t = b[k];
    out.way_x[k] = c.x + u.x * s + v.x * t;
    out.way_y[k] = c.y + u.y * s + v.y * t;
    out.way_z[k] = c.z + u.z * s + v.z * t;
    height[k] = n.x * out.way_x[k] + n.y * out.way_y[k] + n.z * out.way_z[k];
  }
  for (int k = 0; k < kLanes; ++k) above[k] = height[k] > 0.0 ? -1 : 0;
}

struct RayCounts {
  int visible = 0;    ///< unblocked and above the horizon
  int unblocked = 0;  ///< unblocked
  std::size_t rays = 0;
};

/// The packet's rays all start at the receiver. `all`: also trace what is below the horizon, for the
/// unblocked count.
RayCounts trace_receiver(const RayScene& rays, const Aim& aim, const StratumTable& table, std::uint32_t key,
                         bool all, detail::Coherence coherence, detail::RayPacket& packet) {
  RayCounts counts;
  alignas(64) int above[kLanes];
  for (int first = 0; first < table.strata.count(); first += kLanes) {
    aim_at_samples(aim, table, key, first, packet, above);
    const int count = std::min(kLanes, table.strata.count() - first);
    int lanes = 0;
    for (int k = 0; k < kLanes; ++k) {
      packet.wanted[k] = k < count && (all || above[k]) ? -1 : 0;
      lanes -= packet.wanted[k];
    }
    if (lanes == 0) continue;
    counts.rays += static_cast<std::size_t>(lanes);
    detail::find_occluded(rays, packet, coherence);
    for (int k = 0; k < kLanes; ++k) {
      const int open = packet.wanted[k] & ~packet.occluded[k];
      counts.visible -= open & above[k];
      counts.unblocked -= open;
    }
  }
  return counts;
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
  const AreaLight light = area_light(shape);
  const detail::Coherence coherence =
      options.packets ? detail::Coherence::kCoherent : detail::Coherence::kSingly;
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
    if (light.is_behind(receivers.points[receiver])) {
      out.visibility[i] = 0.0f;
      if (with_unoccluded) out.unoccluded[i] = 0.0f;
      return;
    }
    detail::RayPacket packet;
    packet.endless = light.distant;
    for (int k = 0; k < kLanes; ++k) packet.set_start(k, detail::start_of(receivers, receiver));
    const RayCounts counts =
        trace_receiver(rays, Aim(light, receivers, receiver), table,
                       detail::sample_key_of(receivers, receiver, options.seed), all, coherence, packet);
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
