#include "render/d_buffer/center_rays.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "mesh/vectors.h"
#include "render/light/disk_area.h"
#include "render/light/disk_samples.h"
#include "render/rays/ray_packets.h"
#include "render/support/vector_clones.h"

namespace penumbra {

/// Sixteen receivers, in the world.
struct detail::ReceiverLanes {
  const double *x, *y, *z, *nx, *ny, *nz;
};

namespace {

using detail::RayPacket;
using detail::ReceiverLanes;

constexpr std::size_t kLanes = RayPacket::kRays;
/// Speed: pixels a side of a block whose rays share a packet (d_buffer_bench).
constexpr int kBlock = 4;

/// A disk at center - weight · x as seen from x: of a distant light the direction towards it, the same for
/// all x.
struct SeenDisk {
  explicit SeenDisk(const CircularLight& light)
      : normal(detail::unit(light.normal)),
        center(light.is_distant() ? -normal : light.center),
        weight(light.weight),
        radius(light.radius) {}
  Vec3 normal, center;
  double weight, radius;
};

/// The disk as a receiver's horizon lies across it.
struct AboveHorizon {
  /// From the receiver to the disk's center.
  double x, y, z;
  /// Up the disk: the receiver's normal without its part along the light's. And its length.
  double ux, uy, uz, size;
  /// Of the disk's center above the horizon.
  double height;
  /// The receiver lies behind the light's plane or in it.
  bool behind;
};

PENUMBRA_INLINE AboveHorizon above_horizon_of(const ReceiverLanes& from, std::size_t k,
                                              const SeenDisk& disk) {
  AboveHorizon out;
  const Vec3 &c = disk.center, &m = disk.normal;
  out.x = c.x - disk.weight * from.x[k];
  out.y = c.y - disk.weight * from.y[k];
  out.z = c.z - disk.weight * from.z[k];
  const double nx = from.nx[k], ny = from.ny[k], nz = from.nz[k];
  const double along = nx * m.x + ny * m.y + nz * m.z;
  out.ux = nx - along * m.x, out.uy = ny - along * m.y, out.uz = nz - along * m.z;
  out.size = std::sqrt(out.ux * out.ux + out.uy * out.uy + out.uz * out.uz);
  out.height = nx * out.x + ny * out.y + nz * out.z;
  out.behind = out.x * m.x + out.y * m.y + out.z * m.z >= 0.0;
  return out;
}

/// Ways to the points aimed at; those that need not be traced are not wanted.
PENUMBRA_VECTOR_CLONES
void aim(const ReceiverLanes& from, const SeenDisk& disk, RayPacket& packet) {
  for (std::size_t k = 0; k < kLanes; ++k) {
    const AboveHorizon seen = above_horizon_of(from, k, disk);
    const bool lifted = seen.height <= 0.0 && seen.height + disk.radius * seen.size > 0.0;
    // From the center up to the middle between horizon (-height / size) and top (radius).
    const double lift = lifted ? 0.5 * (disk.radius - seen.height / seen.size) / seen.size : 0.0;
    packet.from_x[k] = from.x[k], packet.from_y[k] = from.y[k], packet.from_z[k] = from.z[k];
    packet.way_x[k] = seen.x + lift * seen.ux;
    packet.way_y[k] = seen.y + lift * seen.uy;
    packet.way_z[k] = seen.z + lift * seen.uz;
    packet.wanted[k] = (seen.height > 0.0 || lifted) && !seen.behind ? -1 : 0;
  }
}

}  // namespace

CenterRays::CenterRays(const Receivers& surface, const RayScene& rays)
    : rays_(rays),
      pixels_(surface.size()),
      width_(static_cast<std::uint32_t>(surface.width)),
      place_(surface.size(), 0) {
  const auto count = static_cast<std::size_t>(
      std::count_if(surface.objects.begin(), surface.objects.end(), [](int object) { return object >= 0; }));
  const std::size_t padded = (count + kLanes - 1) / kLanes * kLanes;
  for (auto* list : {&x_, &y_, &z_, &nx_, &ny_, &nz_}) list->assign(padded, 0.0);
  object_.assign(padded, -1);
  face_.assign(padded, 0);
  pixel_.reserve(count);
  const auto add = [&](std::uint32_t i) {
    if (!surface.is_present(i)) return;
    const Vec3 &n = surface.normals[i], &p = surface.points[i];
    const detail::RayStart start = detail::start_of(surface, i);
    const std::size_t k = pixel_.size();
    place_[i] = static_cast<std::uint32_t>(k);
    x_[k] = p.x, y_[k] = p.y, z_[k] = p.z;
    nx_[k] = n.x, ny_[k] = n.y, nz_[k] = n.z;
    object_[k] = start.object, face_[k] = start.face;
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

void CenterRays::center_seen(const CircularLight& light, std::vector<float>& out) const {
  out.assign(pixels_, 1.0f);
  const SeenDisk disk(light);
  const auto trace = [&](const tbb::blocked_range<std::size_t>& packets) {
    RayPacket packet;
    packet.endless = light.is_distant();
    for (std::size_t p = packets.begin(); p < packets.end(); ++p) {
      const std::size_t first = p * kLanes, count = std::min(kLanes, pixel_.size() - first);
      aim(lanes(first), disk, packet);
      std::copy_n(&object_[first], kLanes, packet.object);
      std::copy_n(&face_[first], kLanes, packet.face);
      for (std::size_t k = count; k < kLanes; ++k) packet.wanted[k] = 0;
      detail::find_occluded(rays_, packet, detail::Coherence::kCoherent);
      for (std::size_t k = 0; k < count; ++k)
        if (packet.is_occluded(k)) out[pixel_[first + k]] = 0.0f;
    }
  };
  rays_.arena().execute(
      [&] { tbb::parallel_for(tbb::blocked_range<std::size_t>(0, x_.size() / kLanes, 64), trace); });
}

namespace {

using DiskPoints = std::array<detail::DiskPoint, kLanes>;

/// A sunflower's seeds (Vogel 1979): rings of equal areas, the golden angle between one and the next.
DiskPoints sunflower(double turn) {
  constexpr double kGolden = 2.399963229728653;
  DiskPoints out;
  for (std::size_t k = 0; k < kLanes; ++k) {
    const double radius = std::sqrt((static_cast<double>(k) + 0.5) / kLanes);
    const double angle = kGolden * static_cast<double>(k) + turn;
    out[k] = {static_cast<float>(radius * std::cos(angle)), static_cast<float>(radius * std::sin(angle))};
  }
  return out;
}

/// Each turned against the others.
std::array<DiskPoints, CenterRays::kPatterns> interleaved_points() {
  std::array<DiskPoints, CenterRays::kPatterns> out;
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] = sunflower(2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(out.size()));
  return out;
}

}  // namespace

std::span<const detail::DiskPoint> CenterRays::points(std::size_t pattern) {
  static const auto patterns = interleaved_points();
  return patterns[pattern];
}

SeenPoints CenterRays::look(const CircularLight& light, std::uint32_t pixel, std::size_t pattern) const {
  const std::uint32_t at = place_[pixel];
  SeenPoints out{points(pattern)};
  const LightFrame axes = light_frame(light);
  const Vec3 u = light.radius * axes.u, v = light.radius * axes.v;
  const Vec3 from(x_[at], y_[at], z_[at]), n(nx_[at], ny_[at], nz_[at]), center = way_to_center(light, from);
  if (glm::dot(center, axes.w) >= 0.0) return out;
  RayPacket packet;
  packet.endless = light.is_distant();
  for (std::size_t k = 0; k < kLanes; ++k) {
    const Vec3 way = center + double{out.points[k].x} * u + double{out.points[k].y} * v;
    packet.set(k, {{from, object_[at], face_[at]}, way});
    packet.wanted[k] = glm::dot(way, n) > 0.0 ? -1 : 0;
  }
  // They graze casters: a tenth faster than as coherent rays.
  detail::find_occluded(rays_, packet, detail::Coherence::kIncoherent);
  for (std::size_t k = 0; k < kLanes; ++k) {
    const auto bit = static_cast<std::uint16_t>(1u << k);
    if (packet.wanted[k]) out.traced |= bit;
    if (packet.wanted[k] && !packet.is_occluded(k)) out.seen |= bit;
  }
  return out;
}

std::vector<SeenPoints> CenterRays::seen_points(const CircularLight& light,
                                                std::span<const std::uint32_t> pixels) const {
  std::vector<SeenPoints> out(pixels.size());
  rays_.arena().execute([&] {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, pixels.size(), 8), [&](const auto& range) {
      for (std::size_t i = range.begin(); i < range.end(); ++i)
        out[i] = look(light, pixels[i], pixels[i] / width_ % 3 * 3 + pixels[i] % width_ % 3);
    });
  });
  return out;
}

std::vector<SeenPoints> CenterRays::all_seen_points(const CircularLight& light,
                                                    std::span<const std::uint32_t> pixels) const {
  std::vector<SeenPoints> out(kPatterns * pixels.size());
  rays_.arena().execute([&] {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, out.size(), 8), [&](const auto& range) {
      for (std::size_t i = range.begin(); i < range.end(); ++i)
        out[i] = look(light, pixels[i / kPatterns], i % kPatterns);
    });
  });
  return out;
}

}  // namespace penumbra
