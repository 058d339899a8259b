// The planes of eight edges' faces in float.
#pragma once

#include "render/silhouette/edges/band_edge.h"
#include "render/silhouette/edges/block_bounds.h"
#include "render/support/float_lanes.h"

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
  void set_none(std::size_t lane) {
    const FacePlane front{Vec3(0.0), 1e30, -1.0};
    left.set(lane, front, 1.0);
    right.set(lane, front, 1.0);
  }
};

/// A point in two floats a coordinate: its difference to a float nearby is as exact as floats are.
struct SplitPoint {
  explicit SplitPoint(const Vec3& p) {
    for (int k = 0; k < 3; ++k) {
      high[k] = static_cast<float>(p[k]);
      low[k] = static_cast<float>(p[k] - static_cast<double>(high[k]));
    }
  }
  std::array<float, 3> high, low;
};

/// The same planes with coordinates that start in the edges' midst: for points nearby sides are certain
/// beyond 2^-20 of their distance, instead of that of the whole scene's size.
struct LocalPlanes {
  EdgePlanes planes;
  std::array<float, 3> origin;

  void set(std::size_t lane, BandEdge edge) {
    for (FacePlane* plane : {&edge.left, &edge.right}) {
      const double shift =
          plane->normal.x * origin[0] + plane->normal.y * origin[1] + plane->normal.z * origin[2];
      plane->offset += shift;
      if (plane->tolerance >= 0.0) plane->tolerance += kRounding;
    }
    planes.set(lane, edge, 0.0);
  }
  std::array<float, 3> from_origin(const SplitPoint& p) const {
    std::array<float, 3> out;
    for (int k = 0; k < 3; ++k) out[k] = (p.high[k] - origin[k]) + p.low[k];
    return out;
  }

 private:
  static constexpr double kRounding = 0x1p-36;  // of doubles, even with the light far outside of the scene
};

/// As below, for one receiver.
std::uint32_t may_be_silhouettes(const LocalPlanes& block, const SplitPoint& receiver);

/// Bit i is clear where both faces of edge i keep one side over a box of receivers, the same: then it is not
/// on the silhouette for any of them. Compiled for several instruction sets with the same result.
std::uint32_t may_be_silhouettes(const EdgePlanes& block, const FloatBox& receivers);

}  // namespace penumbra::detail
