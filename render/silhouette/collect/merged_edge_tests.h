// Silhouette method, step collect: which merged edges may stand for a silhouette across the disk, in float.
//
// In: eight merged edges, and the receivers of a shaft or one receiver. Out: a bit an edge, clear where
// what it stands for is certain to lie beside the disk.
//
// What a merged edge stands for is seen within its margin, by receivers that are at twice the radius of its
// curved sides or more (MergedSides). So it is no silhouette across the disk where both its ends lie beyond
// some plane by the margin, and the receivers and the disk lie on that plane's other side. For the
// receivers of a shaft these are the sides of the shaft. For one receiver x it is the plane through x that
// touches the disk towards the middle of the edge. The same serves for a smaller spot in place of the disk.
//
// Also: what of merged edges may be mistaken, as a share of the disk; the bound of merge/merged_edges.h.
//
// All is in float with the margin of block_bounds.h. What is left is tested in double (uncertain_edges.h).
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>

#include "render/silhouette/collect/shaft.h"
#include "render/silhouette/merge/merged_lanes.h"

namespace penumbra::detail {

/// The sides of a shaft. `extent`: the largest coordinate.
struct FloatShaft {
  FloatShaft(const Shaft& shaft, double extent);
  static constexpr std::size_t kSides = 16;
  /// x p.x + y p.y - slope p.z is `least` or less inside.
  std::array<float, kSides> x, y, slope, least;
  /// By how much that changes over a distance of 1, at most.
  std::array<float, kSides> steep;
  /// The receivers' box: its middle, half its sides and half its diagonal, enlarged by the margin.
  std::array<float, 3> middle, half;
  float size;
  /// The least and the largest height of a receiver, by the margin lower and higher.
  float lowest, highest;
  /// The margin of a value of a plane.
  float grain;
  /// At most that much do distances grow by slant where they are seen on the disk, less 1.
  float slant;
};

/// All of the unit disk, or one point of it.
struct DiskSpot {
  glm::dvec2 center{0.0};
  double radius = 1.0;
  static DiskSpot point(const glm::dvec2& at) { return {at, 0.0}; }
  bool is_point() const { return radius == 0.0; }
};

/// One receiver that looks at a spot; x and y from the middle of the spot.
struct FloatEye {
  FloatEye(const TileReceiver& receiver, const DiskSpot& spot, double extent);
  std::array<float, 3> at;
  std::array<float, 2> spot;
  float radius, per_z, grain;
};

/// What a receiver may have mistaken, and where.
struct Mistaken {
  /// A bound on the area of the disk at which merged edges tell a wrong number of faces. Infinite, or not a
  /// number, where something that may be mistaken is not wholly nearer to the light than all receivers.
  float area = 0.0f;
  /// What an edge stands for that is a silhouette is seen on the disk within that distance of it.
  float beside = 0.0f;
};

/// Adds those of eight edges, for each of the receivers of a shaft. Compiled for several instruction sets
/// with the same result.
void add_mistaken(const MergedLanes& edges, const FloatShaft& receivers, Mistaken& out);

/// Bit i is set where edge i may stand for a silhouette across the disk. Compiled for several instruction
/// sets with the same result.
std::uint32_t may_be_across(const MergedLanes& edges, const FloatShaft& receivers);
std::uint32_t may_be_across(const MergedLanes& edges, const FloatEye& receiver);

}  // namespace penumbra::detail
