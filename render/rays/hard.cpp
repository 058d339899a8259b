#include "render/rays/hard.h"

#include <atomic>
#include <chrono>
#include <glm/geometric.hpp>

#include "render/light/area_light.h"
#include "render/rays/each_receiver.h"
#include "render/rays/ray_packets.h"

namespace penumbra {
namespace {

constexpr std::size_t kRays = detail::RayPacket::kRays;

/// Sixteen receivers that follow each other, or fewer: their rays share a packet.
class HardRays {
 public:
  HardRays(const AreaLight& light, const Receivers& receivers, bool horizon)
      : light_(light), receivers_(receivers), horizon_(horizon && receivers.has_normals()) {
    packet_.endless = light.distant;
  }

  /// Values of the receivers of these indices; returns how many rays were traced.
  std::size_t trace(const RayScene& rays, std::span<const std::uint32_t> indices, float* out) {
    std::size_t traced = 0;
    for (std::size_t k = 0; k < kRays; ++k) packet_.wanted[k] = 0;
    for (std::size_t k = 0; k < indices.size(); ++k) {
      out[k] = set(k, indices[k]) ? 1.0f : 0.0f;
      traced += packet_.wanted[k] != 0;
    }
    if (traced > 0) detail::find_occluded(rays, packet_, detail::Coherence::kCoherent);
    for (std::size_t k = 0; k < indices.size(); ++k)
      if (packet_.wanted[k] && packet_.is_occluded(k)) out[k] = 0.0f;
    return traced;
  }

 private:
  /// False where the receiver does not look at the light's center; wants its ray where it does.
  bool set(std::size_t k, std::uint32_t index) {
    if (!receivers_.is_present(index)) return true;
    const Vec3& x = receivers_.points[index];
    const Vec3 way = light_.from_receiver(x);
    if (light_.is_behind(x) || (horizon_ && glm::dot(receivers_.normals[index], way) <= 0.0)) return false;
    packet_.set_start(k, detail::start_of(receivers_, index));
    packet_.set_way(k, way);
    packet_.wanted[k] = -1;
    return true;
  }

  const AreaLight& light_;
  const Receivers& receivers_;
  const bool horizon_;
  detail::RayPacket packet_;
};

}  // namespace

ReferenceResult trace_hard(const RayScene& rays, const LightShape& shape, const Receivers& receivers,
                           std::span<const std::uint32_t> indices, bool horizon) {
  const auto start = std::chrono::steady_clock::now();
  const AreaLight light = area_light(shape);
  ReferenceResult out;
  out.visibility.assign(indices.size(), 1.0f);
  std::atomic<std::size_t> traced{0};
  detail::for_each_receiver(rays.arena(), (indices.size() + kRays - 1) / kRays, {}, [&](std::size_t i) {
    const std::size_t first = i * kRays, count = std::min(kRays, indices.size() - first);
    traced += HardRays(light, receivers, horizon)
                  .trace(rays, indices.subspan(first, count), &out.visibility[first]);
  });
  out.rays = traced;
  out.milliseconds =
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  return out;
}

}  // namespace penumbra
