// The planes of eight edges' faces in float.
#pragma once

#include "render/band_edge.h"
#include "render/block_bounds.h"
#include "render/float_lanes.h"

namespace penumbra::detail {

/// value(x) = (x, y, z)·p + offset as FacePlane has it; beyond ±tolerance its sign is certain for |p| up to
/// twice the extent that it was made for. A face that is missing has value 0 and tolerance -1.
struct alignas(kFloatLanes * sizeof(float)) PlaneLanes {
  Floats x, y, z, offset, tolerance;

  void set(std::size_t lane, const FacePlane& plane, double extent) {
    const double grain = 0x1p-20 * (std::abs(plane.offset) + 4.0 * extent);
    x[lane] = static_cast<float>(plane.normal.x);
    y[lane] = static_cast<float>(plane.normal.y);
    z[lane] = static_cast<float>(plane.normal.z);
    offset[lane] = static_cast<float>(plane.offset);
    tolerance[lane] = plane.tolerance < 0.0 ? -1.0f : static_cast<float>(plane.tolerance + grain);
  }
};

struct EdgePlanes {
  PlaneLanes left, right;

  void set(std::size_t lane, const BandEdge& edge, double extent) {
    left.set(lane, edge.left, extent);
    right.set(lane, edge.right, extent);
  }
  /// No edge: two faces that look the same way wherever they are seen from, however large what sees them.
  void set_idle(std::size_t lane) {
    const FacePlane front{Vec3(0.0), 1e30, -1.0};
    left.set(lane, front, 1.0);
    right.set(lane, front, 1.0);
  }
};

/// Signs of a plane over a box of receivers, 0 where it has none; its tolerance covers the rounding.
PENUMBRA_INLINE void sides_of(const PlaneLanes& plane, const FloatBox& box, Ints& out) {
  const auto& [m, half] = box;
  const Floats value = plane.x * m[0] + plane.y * m[1] + plane.z * m[2] + plane.offset;
  const Floats reach =
      magnitude(plane.x) * half[0] + magnitude(plane.y) * half[1] + magnitude(plane.z) * half[2];
  const Floats least = 1.0001f * reach + plane.tolerance;
  out = (magnitude(value) > least) & ((value > 0.0f) - (value < 0.0f));
}

/// Bit i is clear where both faces of edge i keep one side over a box of receivers, the same: then it is not
/// on the silhouette for any of them.
PENUMBRA_INLINE std::uint32_t may_be_silhouettes(const EdgePlanes& block, const FloatBox& receivers) {
  Ints left, right;
  sides_of(block.left, receivers, left);
  sides_of(block.right, receivers, right);
  return bits_of(~((left == right) & (left != 0)));
}

}  // namespace penumbra::detail
