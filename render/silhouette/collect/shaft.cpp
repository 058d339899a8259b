#include "render/silhouette/collect/shaft.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

#include "render/support/vector_clones.h"

namespace penumbra::detail {
namespace {

/// Of the sides.
struct Directions {
  Directions() {
    for (int k = 0; k < kShaftSides; ++k) {
      x[k] = std::cos(2.0 * std::numbers::pi * k / kShaftSides);
      y[k] = std::sin(2.0 * std::numbers::pi * k / kShaftSides);
    }
  }
  alignas(64) std::array<double, kShaftSides> x, y;
};
const Directions kDirections;

/// The slopes of the sides that touch the receivers: the largest that one of them asks for, side by side.
PENUMBRA_VECTOR_CLONES
void tighten_slopes(const TileReceiver* receivers, std::size_t count, double* __restrict slope) {
  const double *cosine = kDirections.x.data(), *sine = kDirections.y.data();
  alignas(64) double most[kShaftSides];
  for (int k = 0; k < kShaftSides; ++k) most[k] = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3& p = receivers[i].x;
    const double per_z = 1.0 / p.z, px = p.x * per_z, py = p.y * per_z;
    for (int k = 0; k < kShaftSides; ++k) {
      const double s = cosine[k] * px + sine[k] * py - per_z;
      most[k] = s > most[k] ? s : most[k];
    }
  }
  for (int k = 0; k < kShaftSides; ++k) slope[k] = most[k];
}

/// Whether something lies beyond one of the sides, d·p.xy - 1 - slope p.z > 0. `least`: the least d·p.xy -
/// slope p.z over it. All sides at once, without branches.
template <class Least>
PENUMBRA_INLINE bool is_beyond_some_side(const double* slope, double margin, const Least& least) {
  const double *cosine = kDirections.x.data(), *sine = kDirections.y.data();
  int any = 0;
  for (int k = 0; k < kShaftSides; ++k)
    any |= least(cosine[k], sine[k], slope[k]) - 1.0 > margin * (1.0 + std::abs(slope[k])) ? 1 : 0;
  return any != 0;
}

PENUMBRA_VECTOR_CLONES
bool box_is_beyond(const Vec3& low, const Vec3& high, const double* slope, double margin) {
  const double x0 = low.x, x1 = high.x, y0 = low.y, y1 = high.y, z0 = low.z, z1 = high.z;
  return is_beyond_some_side(slope, margin, [=](double c, double s, double rise) {
    return (c > 0.0 ? c * x0 : c * x1) + (s > 0.0 ? s * y0 : s * y1) - (rise > 0.0 ? rise * z1 : rise * z0);
  });
}

PENUMBRA_VECTOR_CLONES
bool edge_is_beyond(const Vec3& a, const Vec3& b, const double* slope, double margin) {
  const double ax = a.x, ay = a.y, az = a.z, bx = b.x, by = b.y, bz = b.z;
  return is_beyond_some_side(slope, margin, [=](double c, double s, double rise) {
    const double at_a = c * ax + s * ay - rise * az, at_b = c * bx + s * by - rise * bz;
    return at_a < at_b ? at_a : at_b;
  });
}

}  // namespace

namespace {

Bounds box_of(std::span<const TileReceiver> receivers) {
  Bounds box;
  for (const TileReceiver& r : receivers) box.add(r.x);
  return box;
}

}  // namespace

Shaft::Shaft(std::span<const TileReceiver> receivers, double extent) : Shaft(box_of(receivers), extent) {}

Shaft::Shaft(const Bounds& box, double extent) : margin_(0x1p-44 * extent) {
  top_ = box.high.z;
  middle_ = box.center();
  half_ = 0.5 * (box.high - box.low);
  for (int k = 0; k < kShaftSides; ++k) {
    const double x = kDirections.x[k], y = kDirections.y[k];
    const double beyond = x * middle_.x + y * middle_.y + std::abs(x) * half_.x + std::abs(y) * half_.y - 1.0;
    slope_[k] = beyond / (beyond > 0.0 ? box.low.z : box.high.z);
  }
}

void Shaft::tighten(std::span<const TileReceiver> receivers) {
  tighten_slopes(receivers.data(), receivers.size(), slope_.data());
  horizon_ =
      std::any_of(receivers.begin(), receivers.end(), [](const TileReceiver& r) { return r.horizon_cuts; });
  if (horizon_) horizons_ = Horizons(receivers, middle_);
}

Shaft::Horizons::Horizons(std::span<const TileReceiver> receivers, const Vec3& middle) {
  Bounds box;
  for (const TileReceiver& r : receivers) {
    box.add(r.normal);
    lowest = std::min(lowest, glm::dot(r.normal, r.x - middle));
  }
  low = box.low, high = box.high;
}

Shaft::Side Shaft::side_plane(int k) const {
  if (k == kShaftSides) return {{0.0, 0.0, 1.0}, -top_};
  return {{kDirections.x[k], kDirections.y[k], -slope_[k]}, -1.0};
}

ReceiverRegion Shaft::region(std::span<const TileReceiver> receivers, const UnitLight& light,
                             const RayFrame& frame) const {
  // The sides in the frame of rays.
  static_assert(ReceiverRegion::kPlanes == kShaftSides + 1);
  std::array<ReceiverRegion::Plane, ReceiverRegion::kPlanes> planes;
  const double scale = light.per_radius() / frame.scale;  // light radii a unit of the frame
  const Vec3 origin = light.point(frame.origin);
  for (int k = 0; k <= kShaftSides; ++k) {
    const Side side = side_plane(k);
    const double per_length = 1.0 / (scale * glm::length(side.normal));
    planes[k] = {per_length * scale * light.world_direction(side.normal),
                 per_length * (glm::dot(side.normal, origin) + side.offset)};
  }

  // The receivers' box, their horizons, and the receivers.
  const auto rotated = [&](const Vec3& half) {  // the box of a rotated box
    return glm::abs(light.world_direction({half.x, 0.0, 0.0})) +
           glm::abs(light.world_direction({0.0, half.y, 0.0})) +
           glm::abs(light.world_direction({0.0, 0.0, half.z}));
  };
  ReceiverRegion out(planes, light.world_direction(middle_ - origin) / scale, rotated(half_) / scale);
  const Horizons horizons(receivers, middle_);
  out.add_horizon(light.world_direction(0.5 * (horizons.low + horizons.high)),
                  rotated(0.5 * (horizons.high - horizons.low)), horizons.lowest / scale);
  for (const TileReceiver& r : receivers)
    out.add_receiver(light.world_direction(r.x - origin) / scale, light.world_direction(r.normal));
  return out;
}

bool Shaft::below_horizons(const Vec3& p) const {
  const Vec3 d = p - middle_;
  double highest = 0.0;
  for (int k = 0; k < 3; ++k) highest += std::max(horizons_.low[k] * d[k], horizons_.high[k] * d[k]);
  return highest < horizons_.lowest - margin_;
}

bool Shaft::misses(const Vec3& low, const Vec3& high) const {
  return low.z > top_ + margin_ || box_is_beyond(low, high, slope_.data(), margin_);
}

bool Shaft::misses(const BandEdge& e) const {
  if (std::min(e.a.z, e.b.z) > top_ + margin_) return true;
  if (edge_is_beyond(e.a, e.b, slope_.data(), margin_)) return true;
  return horizon_ && below_horizons(e.a) && below_horizons(e.b);
}

}  // namespace penumbra::detail
