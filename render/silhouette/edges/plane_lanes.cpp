#include "render/silhouette/edges/plane_lanes.h"

#include <cmath>

namespace penumbra::detail {
namespace {

/// The signs of eight planes over a box of receivers; 0 where a plane has no certain sign. The tolerance
/// covers the rounding of the sums.
PENUMBRA_INLINE void sides_of(const PlaneLanes& plane, const FloatBox& box, Ints& out) {
  const auto& [m, half] = box;
  const Floats value = plane.x * m[0] + plane.y * m[1] + plane.z * m[2] + plane.offset;
  const Floats reach =
      magnitude(plane.x) * half[0] + magnitude(plane.y) * half[1] + magnitude(plane.z) * half[2];
  const Floats least = 1.0001f * reach + plane.tolerance;
  out = (magnitude(value) > least) & ((value > 0.0f) - (value < 0.0f));
}

/// The same for a point in the coordinates of the planes.
PENUMBRA_INLINE void sides_of(const PlaneLanes& plane, const std::array<float, 3>& p, Ints& out) {
  const Floats value = plane.x * p[0] + plane.y * p[1] + plane.z * p[2] + plane.offset;
  const float grain = 0x1p-20f * (std::abs(p[0]) + std::abs(p[1]) + std::abs(p[2]));
  out = (magnitude(value) > plane.tolerance + grain) & ((value > 0.0f) - (value < 0.0f));
}

}  // namespace

PENUMBRA_VECTOR_CLONES
std::uint32_t may_be_silhouettes(const LocalPlanes& block, const SplitPoint& receiver) {
  const std::array<float, 3> p = block.from_origin(receiver);
  Ints left, right;
  sides_of(block.planes.left, p, left);
  sides_of(block.planes.right, p, right);
  return bits_of(~((left == right) & (left != 0)));
}

PENUMBRA_VECTOR_CLONES
std::uint32_t may_be_silhouettes(const EdgePlanes& block, const FloatBox& receivers) {
  Ints left, right;
  sides_of(block.left, receivers, left);
  sides_of(block.right, receivers, right);
  return bits_of(~((left == right) & (left != 0)));
}

}  // namespace penumbra::detail
