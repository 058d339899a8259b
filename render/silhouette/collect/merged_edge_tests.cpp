#include "render/silhouette/collect/merged_edge_tests.h"

#include <cmath>
#include <glm/geometric.hpp>

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

}  // namespace

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
  for (int k = 0; k < 3; ++k) middle[k] = static_cast<float>(shaft.middle()[k]);
}

FloatEye::FloatEye(const TileReceiver& receiver, double extent)
    : per_z(static_cast<float>(1.0 / receiver.x.z)), grain(static_cast<float>(kBoundsGrain * extent)) {
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
  // The directions from the disk's center to where the edges' middles are seen.
  const Floats t = 0.5f * (e.a[2] + e.b[2]) * eye.per_z;
  const Floats x = 0.5f * (e.a[0] + e.b[0]) - t * eye.at[0], y = 0.5f * (e.a[1] + e.b[1]) - t * eye.at[1];
  Floats length2 = x * x + y * y;
  Floats per_length;
  for (int lane = 0; lane < kFloatLanes; ++lane)
    per_length[lane] = 1.0f / std::sqrt(length2[lane] > 1e-30f ? length2[lane] : 1e-30f);
  // Unit but for rounding, which the grain covers; a plane with 1 - |d| of offset more still holds the disk.
  const Floats dx = x * per_length, dy = y * per_length;

  // The planes that touch the disk there, and the ends' distances from them.
  const Floats slope = (dx * eye.at[0] + dy * eye.at[1] - 1.0f) * eye.per_z;
  const Floats steep = 1.0f + magnitude(slope);
  const Floats least = 1.0f + (e.margin + eye.grain) * steep;
  const Floats at_a = dx * e.a[0] + dy * e.a[1] - slope * e.a[2];
  const Floats at_b = dx * e.b[0] + dy * e.b[1] - slope * e.b[2];
  return remaining(e, (at_a > least) & (at_b > least), eye.at, 0.0f);
}

}  // namespace penumbra::detail
