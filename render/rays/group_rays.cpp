#include "render/rays/group_rays.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "render/support/vector_clones.h"

namespace penumbra::detail {
namespace {

constexpr std::size_t kRays = RayPacket::kRays;
constexpr double kNoWay = 1e-30;  // a shorter way is none

/// In the group's frame.
struct Lanes {
  alignas(64) double x[kRays], y[kRays], z[kRays];
  /// About 1 in the largest coordinate.
  alignas(64) double way_x[kRays], way_y[kRays], way_z[kRays];
  /// Where the light point lies, in units of the way. And where the ray is to start.
  alignas(64) double end[kRays], begin[kRays];
};

/// Returns whether some ray starts outside of the box.
PENUMBRA_VECTOR_CLONES
bool to_frame(const RayPacket& packet, const GroupFrame& frame, Lanes& out) {
  const double unit = packet.endless ? 1.0 : frame.scale;
  const double endless = packet.endless ? std::numeric_limits<double>::infinity() : 0.0;
  std::int64_t outside = 0;
  for (std::size_t k = 0; k < kRays; ++k) {
    out.x[k] = (packet.from_x[k] - frame.origin.x) * frame.scale;
    out.y[k] = (packet.from_y[k] - frame.origin.y) * frame.scale;
    out.z[k] = (packet.from_z[k] - frame.origin.z) * frame.scale;
    outside |= (out.x[k] < frame.low.x) | (out.x[k] > frame.high.x) | (out.y[k] < frame.low.y) |
               (out.y[k] > frame.high.y) | (out.z[k] < frame.low.z) | (out.z[k] > frame.high.z);
  }
  for (std::size_t k = 0; k < kRays; ++k) {
    const double x = packet.way_x[k] * unit, y = packet.way_y[k] * unit, z = packet.way_z[k] * unit;
    const double xy = std::abs(x) > std::abs(y) ? std::abs(x) : std::abs(y);
    const double all = xy > std::abs(z) ? xy : std::abs(z), length = all > kNoWay ? all : kNoWay;
    // Any length near 1 will do, so that float may divide.
    const double per_length = 1.0f / static_cast<float>(length);
    out.way_x[k] = x * per_length;
    out.way_y[k] = y * per_length;
    out.way_z[k] = z * per_length;
    out.end[k] = length + endless;
    out.begin[k] = -kBeyondEnds;
  }
  return outside != 0;
}

/// The part of a line between two planes across one axis: where it enters and where it leaves.
PENUMBRA_INLINE void cut(double from, double way, double low, double high, double& enter, double& leave) {
  constexpr double kAlmostNone = 1e-300;  // no product with it overflows, and no quotient is undefined
  const double per_unit = 1.0 / (std::abs(way) > kAlmostNone ? way : kAlmostNone);
  const double a = (low - from) * per_unit, b = (high - from) * per_unit;
  const double near = a < b ? a : b, far = a < b ? b : a;
  enter = near > enter ? near : enter;
  leave = far < leave ? far : leave;
}

/// Rays that start outside begin shortly before they enter the box; those that miss it are not valid.
PENUMBRA_VECTOR_CLONES
void cut_to_box(const GroupFrame& frame, Lanes& lanes, int* valid) {
  alignas(64) double misses[kRays];
  for (std::size_t k = 0; k < kRays; ++k) {
    double enter = -std::numeric_limits<double>::infinity(), leave = lanes.end[k];
    cut(lanes.x[k], lanes.way_x[k], frame.low.x, frame.high.x, enter, leave);
    cut(lanes.y[k], lanes.way_y[k], frame.low.y, frame.high.y, enter, leave);
    cut(lanes.z[k], lanes.way_z[k], frame.low.z, frame.high.z, enter, leave);
    misses[k] = enter > leave || leave < 0.0 ? 1.0 : 0.0;
    const double begin = enter - kBeforeBox;
    lanes.begin[k] = begin > -kBeyondEnds ? begin : -kBeyondEnds;
  }
  for (std::size_t k = 0; k < kRays; ++k) valid[k] = misses[k] != 0.0 ? 0 : valid[k];
}

/// Embree looks at rays that are not valid, too, where the processor has no registers for sixteen: they are
/// made to end before they begin.
PENUMBRA_VECTOR_CLONES
void empty_others(GroupRays& rays) {
  for (std::size_t k = 0; k < kRays; ++k) {
    const bool valid = rays.valid[k] != 0;
    rays.ray.org_x[k] = valid ? rays.ray.org_x[k] : 0.0f;
    rays.ray.org_y[k] = valid ? rays.ray.org_y[k] : 0.0f;
    rays.ray.org_z[k] = valid ? rays.ray.org_z[k] : 0.0f;
    rays.ray.dir_x[k] = valid ? rays.ray.dir_x[k] : 1.0f;
    rays.ray.dir_y[k] = valid ? rays.ray.dir_y[k] : 1.0f;
    rays.ray.dir_z[k] = valid ? rays.ray.dir_z[k] : 1.0f;
    rays.ray.tfar[k] = valid ? rays.ray.tfar[k] : -1.0f;
  }
}

PENUMBRA_VECTOR_CLONES
void round_to_float(const Lanes& lanes, GroupRays& out) {
  for (std::size_t k = 0; k < kRays; ++k) {
    const double begin = lanes.begin[k], end = lanes.end[k] - begin, last = end + kBeyondEnds;
    out.ray.org_x[k] = static_cast<float>(lanes.x[k] + begin * lanes.way_x[k]);
    out.ray.org_y[k] = static_cast<float>(lanes.y[k] + begin * lanes.way_y[k]);
    out.ray.org_z[k] = static_cast<float>(lanes.z[k] + begin * lanes.way_z[k]);
    out.ray.dir_x[k] = static_cast<float>(lanes.way_x[k]);
    out.ray.dir_y[k] = static_cast<float>(lanes.way_y[k]);
    out.ray.dir_z[k] = static_cast<float>(lanes.way_z[k]);
    out.ray.tfar[k] = static_cast<float>(last < kLongestRay ? last : kLongestRay);
    out.at_start[k] = static_cast<float>(-begin);
    out.at_end[k] = static_cast<float>(end);
  }
}

}  // namespace

GroupRays::GroupRays() {
  for (std::uint32_t k = 0; k < kRays; ++k) {
    ray.tnear[k] = 0.0f;
    ray.time[k] = 0.0f;
    ray.mask[k] = ~0u;
    ray.id[k] = k;
    ray.flags[k] = 0;
  }
}

bool GroupRays::set(const RayPacket& packet, const std::int32_t* wanted, const GroupFrame& frame) {
  Lanes lanes;
  std::copy_n(wanted, kRays, valid);
  if (to_frame(packet, frame, lanes)) cut_to_box(frame, lanes, valid);
  round_to_float(lanes, *this);
  empty_others(*this);
  return std::any_of(valid, valid + kRays, [](int each) { return each != 0; });
}

}  // namespace penumbra::detail
