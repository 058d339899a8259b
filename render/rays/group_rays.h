// Sixteen rays in the frame of one group: from double in the world to float within the group's box.
//
// A float ray is only as good as its start. So each ray is cut to the part that may meet the group's faces,
// in double, before it is rounded. Wherever receiver and light are, coordinates then stay within about 1.2.
#pragma once

#include <embree3/rtcore.h>

#include "render/rays/ray_packets.h"

namespace penumbra::detail {

/// A float ray starts this long before its receiver where that lies in the box, and ends this long beyond the
/// light point: further than float can misplace a face that the ray does not graze at less than a thousandth
/// of a radian. In units of the frame; directions are about 1 long in their largest coordinate.
inline constexpr double kBeyondEnds = 0x1p-12;
/// And this long before it enters the box where the receiver lies outside.
inline constexpr double kBeforeBox = 0x1p-3;
/// The group's box is widened by this.
inline constexpr double kBoxMargin = 0x1p-10;
/// Longer than any ray within the box: 2 + 2·kBoxMargin + kBeforeBox + kBeyondEnds.
inline constexpr double kLongestRay = 2.25;

/// local = (world - origin) · scale, and the box of the group's faces in it, widened.
struct GroupFrame {
  Vec3 origin{0.0};
  double scale = 1.0;
  Vec3 low{-1.0}, high{1.0};
};

struct GroupRays {
  /// Embree's; its `id` is the ray's place.
  alignas(64) RTCRay16 ray;
  alignas(64) int valid[RayPacket::kRays];
  /// Where on the float ray the receiver lies (below 0 where the ray begins further on), and the light point.
  alignas(64) float at_start[RayPacket::kRays], at_end[RayPacket::kRays];

  GroupRays();
  /// Those of the packet's rays that are `wanted` and meet the box are valid. True where there are any.
  bool set(const RayPacket& packet, const std::int32_t* wanted, const GroupFrame& frame);
};

}  // namespace penumbra::detail
