// Silhouette method, step edges: the planes of eight edges' faces in float, and which edges may be
// silhouettes.
//
// In: eight edges, and a receiver or a box of receivers. Out: a bit an edge, clear where both faces are
// certain to be on the same side for all the receivers: the edge is then no silhouette for any of them.
#pragma once

#include "render/silhouette/edges/band_edge.h"
#include "render/silhouette/edges/block_bounds.h"
#include "render/support/float_lanes.h"

namespace penumbra::detail {

/// Eight planes. A plane's value at p is (x, y, z)·p + offset, as for FacePlane. Beyond ±tolerance its sign
/// is certain, for |p| up to twice the extent that it was made for. A face that is missing has value 0 and
/// tolerance -1.
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

/// The planes of eight edges.
struct EdgePlanes {
  PlaneLanes left, right;

  void set(std::size_t lane, const BandEdge& edge, double extent) {
    left.set(lane, edge.left, extent);
    right.set(lane, edge.right, extent);
  }
  /// A lane without an edge: two faces that are on the same side for every receiver.
  void set_none(std::size_t lane) {
    const FacePlane front{Vec3(0.0), 1e30, -1.0};
    left.set(lane, front, 1.0);
    right.set(lane, front, 1.0);
  }
};

/// A point in two floats a coordinate, so that its difference to a nearby float is exact to a rounding of the
/// difference.
struct SplitPoint {
  explicit SplitPoint(const Vec3& p) {
    for (int k = 0; k < 3; ++k) {
      high[k] = static_cast<float>(p[k]);
      low[k] = static_cast<float>(p[k] - static_cast<double>(high[k]));
    }
  }
  std::array<float, 3> high, low;
};

/// The planes of eight edges in coordinates that start at the edges. For a nearby point its sides are
/// certain beyond 2^-20 of its distance from the edges, instead of 2^-20 of the size of the scene.
struct LocalPlanes {
  EdgePlanes planes;
  /// Where the coordinates start. To be set before any edge.
  std::array<float, 3> origin;

  void set(std::size_t lane, BandEdge edge) {
    // Shift the planes to the origin.
    for (FacePlane* plane : {&edge.left, &edge.right}) {
      const double shift =
          plane->normal.x * origin[0] + plane->normal.y * origin[1] + plane->normal.z * origin[2];
      plane->offset += shift;
      if (plane->tolerance >= 0.0) plane->tolerance += kRounding;
    }
    planes.set(lane, edge, 0.0);
  }
  /// The point in the coordinates of the planes; of a homogeneous point (p, weight) its first three numbers.
  std::array<float, 3> from_origin(const SplitPoint& p, float weight = 1.0f) const {
    std::array<float, 3> out;
    for (int k = 0; k < 3; ++k) out[k] = (p.high[k] - weight * origin[k]) + p.low[k];
    return out;
  }

 private:
  /// Accuracy. What rounding of doubles adds to a value in [-1, 1], also with the light far outside of the
  /// scene. Held by the test LocalPlanes.
  static constexpr double kRounding = 0x1p-36;
};

/// Bit i is clear where both faces of edge i are certain to be on the same side for all receivers of a box.
/// Compiled for several instruction sets with the same result.
std::uint32_t may_be_silhouettes(const EdgePlanes& block, const FloatBox& receivers);

/// The same for one receiver.
std::uint32_t may_be_silhouettes(const LocalPlanes& block, const SplitPoint& receiver);

}  // namespace penumbra::detail
