#include "render/silhouette/collect/merged_edge_tests.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "render/silhouette/edges/block_bounds.h"

namespace penumbra::detail {
namespace {

/// Sides that are flat, or at twice their radius or more from all receivers within `size` of `from`.
PENUMBRA_INLINE void are_far(const MergedLanes::Side& side, const std::array<float, 3>& from, float size,
                             Ints& out) {
  Floats distance2{};
  for (int k = 0; k < 3; ++k) {
    const Floats d = side.center[k] - from[k];
    distance2 += d * d;
  }
  const Floats reach = side.reach + size;
  out = (reach < 0.0f) | (distance2 > reach * reach);
}

/// The edges that are not certain to be beside the disk.
PENUMBRA_INLINE std::uint32_t remaining(const MergedLanes& e, const Ints& beside,
                                        const std::array<float, 3>& from, float size) {
  Ints left, right;
  are_far(e.left, from, size, left);
  are_far(e.right, from, size, right);
  return bits_of(~(beside & left & right));
}

/// What eight sides may have mistaken from a box of receivers, and on which side of them the receivers are:
/// of all their faces, and of their mean planes; 0 where that is not certain.
PENUMBRA_INLINE void look_at(const MergedLanes::Side& side, const FloatShaft& receivers, Floats& area,
                             Ints& of_all, Ints& of_mean) {
  Floats y[3], value{}, reach{}, length2{};
  for (int k = 0; k < 3; ++k) {
    y[k] = receivers.middle[k] - side.center[k];
    value += side.normal[k] * y[k];
    reach += magnitude(side.normal[k]) * receivers.half[k];
    length2 += y[k] * y[k];
  }
  const auto& t = side.turned;
  Floats turned2 = y[0] * (t[0] * y[0] + 2.0f * (t[1] * y[1] + t[2] * y[2])) +
                   y[1] * (t[3] * y[1] + 2.0f * t[4] * y[2]) + t[5] * y[2] * y[2];
  Floats length, turned;
  for (int lane = 0; lane < kFloatLanes; ++lane) {
    length[lane] = std::sqrt(length2[lane]);
    turned[lane] = std::sqrt(turned2[lane] > 0.0f ? turned2[lane] : 0.0f);
  }
  const Floats least = magnitude(value) - 1.0001f * reach - receivers.grain;
  const Ints sign = (value > 0.0f) - (value < 0.0f);
  of_mean = (least > 0.0f) & sign;
  of_all = (least > 1.0001f * side.tilt * (length + receivers.size) + side.spread) & sign;

  // ½ (√(S² + G²) - G), for the largest S and the least G of the box. The root of `turned` is off by 2^-10 of
  // it and 2^-10 of the length of y at most.
  const Floats s = 1.001f * turned + side.trace * (0.001f * length + receivers.size) + side.shifted;
  const Floats g = side.area * (least > 0.0f ? least : Floats{});
  Floats root;
  for (int lane = 0; lane < kFloatLanes; ++lane)
    root[lane] = std::sqrt(s[lane] * s[lane] + g[lane] * g[lane]);
  const Floats some = s > 0.0f ? 0.5001f * s * (s / (root + g)) : Floats{};
  area = of_all == 0 ? some : Floats{};
}

/// Lanes whose boxes lie beyond a side of the shaft.
PENUMBRA_INLINE void boxes_beyond(const MergedLanes& e, const FloatShaft& shaft, Ints& out) {
  out = Ints{};
  for (std::size_t k = 0; k < FloatShaft::kSides; ++k) {
    const Floats at = shaft.x[k] * e.middle[0] + shaft.y[k] * e.middle[1] - shaft.slope[k] * e.middle[2];
    const Floats reach = std::abs(shaft.x[k]) * e.half[0] + std::abs(shaft.y[k]) * e.half[1] +
                         std::abs(shaft.slope[k]) * e.half[2];
    out |= at - 1.0001f * reach > shaft.least[k];
  }
}

}  // namespace

PENUMBRA_VECTOR_CLONES
void add_mistaken(const MergedLanes& e, const FloatShaft& receivers, Mistaken& out) {
  Floats of_left, of_right;
  Ints left, right, mean_left, mean_right;
  look_at(e.left, receivers, of_left, left, mean_left);
  look_at(e.right, receivers, of_right, right, mean_right);
  const Ints same = (left == right) & (left != 0), same_mean = (mean_left == mean_right) & (mean_left != 0);
  const Floats none{};
  const Floats sides = same ? none : of_left + of_right;
  const Floats swept = same_mean ? none : e.swept, swept_at_any = same_mean ? none : e.swept_at_any;
  const Floats stray = same_mean ? none : e.stray;
  if (bits_of((sides > 0.0f) | (swept > 0.0f) | (swept_at_any > 0.0f)) == 0) return;
  Ints beyond;
  boxes_beyond(e, receivers, beyond);

  // As the disk shows it.
  Floats away2{}, size2{};
  for (int k = 0; k < 3; ++k) {
    const Floats d = receivers.middle[k] - e.middle[k];
    away2 += d * d, size2 += e.half[k] * e.half[k];
  }
  Floats away;
  for (int lane = 0; lane < kFloatLanes; ++lane)
    away[lane] = std::sqrt(away2[lane]) + std::sqrt(size2[lane]) + receivers.size;
  const Floats below = receivers.lowest - (e.middle[2] + e.half[2]);
  const Floats seen =
      below > 0.0f ? receivers.highest / below : none + std::numeric_limits<float>::infinity();
  const Floats area = (sides + swept * away + swept_at_any) * (seen * seen) / below * 1.0001f;
  const Floats beside = stray * seen * (1.0f + receivers.slant);
  for (int lane = 0; lane < kFloatLanes; ++lane) {
    if (beyond[lane] != 0) continue;
    if (sides[lane] > 0.0f || swept[lane] > 0.0f || swept_at_any[lane] > 0.0f)
      out.area += below[lane] > 0.0f ? area[lane] : std::numeric_limits<float>::infinity();
    if (stray[lane] > 0.0f) out.beside = std::max(out.beside, beside[lane]);
  }
}

FloatShaft::FloatShaft(const Shaft& shaft, double extent)
    : size(enlarged(glm::length(shaft.half()), kBoundsGrain * extent)) {
  static_assert(kSides == kShaftSides);
  for (int k = 0; k < kShaftSides; ++k) {
    const Shaft::Side side = shaft.side_plane(k);
    x[k] = static_cast<float>(side.normal.x), y[k] = static_cast<float>(side.normal.y);
    slope[k] = static_cast<float>(-side.normal.z);
    steep[k] = enlarged(1.0 + std::abs(side.normal.z), 0.0);
    least[k] = static_cast<float>(-side.offset + kBoundsGrain * extent * (1.0 + std::abs(side.normal.z)));
  }
  grain = static_cast<float>(kBoundsGrain * extent);
  for (int k = 0; k < 3; ++k) {
    middle[k] = static_cast<float>(shaft.middle()[k]);
    half[k] = enlarged(shaft.half()[k], grain);
  }
  const double low = shaft.middle().z - shaft.half().z, high = shaft.middle().z + shaft.half().z;
  lowest = static_cast<float>(low - grain), highest = enlarged(high, grain);
  const double across = std::hypot(shaft.middle().x, shaft.middle().y) + glm::length(shaft.half());
  slant = enlarged((across + 1.0) / low, 0.0);
}

FloatEye::FloatEye(const TileReceiver& receiver, const DiskSpot& of, double extent)
    : radius(static_cast<float>(of.radius)),
      per_z(static_cast<float>(1.0 / receiver.x.z)),
      grain(static_cast<float>(kBoundsGrain * extent)) {
  for (int k = 0; k < 2; ++k) spot[k] = static_cast<float>(of.center[k]);
  for (int k = 0; k < 3; ++k) at[k] = static_cast<float>(receiver.x[k]);
}

PENUMBRA_VECTOR_CLONES
std::uint32_t may_be_across(const MergedLanes& e, const FloatShaft& shaft) {
  Ints beside{};
  for (std::size_t k = 0; k < FloatShaft::kSides; ++k) {
    const Floats at_a = shaft.x[k] * e.a[0] + shaft.y[k] * e.a[1] - shaft.slope[k] * e.a[2];
    const Floats at_b = shaft.x[k] * e.b[0] + shaft.y[k] * e.b[1] - shaft.slope[k] * e.b[2];
    const Floats least = shaft.least[k] + shaft.steep[k] * e.margin;
    beside |= (at_a > least) & (at_b > least);
  }
  return remaining(e, beside, shaft.middle, shaft.size);
}

PENUMBRA_VECTOR_CLONES
std::uint32_t may_be_across(const MergedLanes& e, const FloatEye& eye) {
  // The directions from the spot's middle to where the edges' middles are seen.
  const float eye_x = eye.at[0] - eye.spot[0], eye_y = eye.at[1] - eye.spot[1];
  const Floats ax = e.a[0] - eye.spot[0], ay = e.a[1] - eye.spot[1];
  const Floats bx = e.b[0] - eye.spot[0], by = e.b[1] - eye.spot[1];
  const Floats t = 0.5f * (e.a[2] + e.b[2]) * eye.per_z;
  const Floats x = 0.5f * (ax + bx) - t * eye_x, y = 0.5f * (ay + by) - t * eye_y;
  Floats length2 = x * x + y * y;
  Floats per_length;
  for (int lane = 0; lane < kFloatLanes; ++lane)
    per_length[lane] = 1.0f / std::sqrt(length2[lane] > 1e-30f ? length2[lane] : 1e-30f);
  // Unit but for rounding, which the grain covers; a plane with 1 - |d| of offset more still holds the spot.
  const Floats dx = x * per_length, dy = y * per_length;

  // The planes that touch the spot there, and the ends' distances from them.
  const Floats slope = (dx * eye_x + dy * eye_y - eye.radius) * eye.per_z;
  const Floats steep = 1.0f + magnitude(slope);
  const Floats least = eye.radius + (e.margin + eye.grain) * steep;
  const Floats at_a = dx * ax + dy * ay - slope * e.a[2];
  const Floats at_b = dx * bx + dy * by - slope * e.b[2];
  return remaining(e, (at_a > least) & (at_b > least), eye.at, 0.0f);
}

}  // namespace penumbra::detail
