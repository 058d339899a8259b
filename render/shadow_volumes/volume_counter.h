// Method shadow-volumes, step count: in how many shadow volumes a point lies.
//
// In: caps and sides, a point. Out: the number of volumes around it, by the polygons on a line from it to
// infinity: those at which the line leaves a volume minus those at which it enters one. That is z-fail, for
// an eye that is infinitely far away on the other end of the line. All lines have one direction, so the
// polygons are sorted in two dimensions, across it.
//
// With A, B, C the ways from the point to an edge's ends and to the center (of a distant light the direction
// towards it) and d the line's direction, the line meets the plane of A, B, C at det(A, B, C) / s, s = det(A,
// B, d) + det(B, C, d) + det(C, A, d) (without the first of a distant light), and there it is beyond the edge
// where det(B, C, d) and det(C, A, d) have the sign of s and det(A, B, d) has the other one. Each determinant
// depends on two points only: polygons that share them get the same bits, and no line slips between them.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "penumbra/render/receivers/receivers.h"
#include "render/center_view/volume_polygons.h"
#include "render/light/area_light.h"
#include "render/rays/ray_packets.h"

namespace penumbra::detail {

struct CounterOptions {
  /// Sides end below the deepest receiver, else at infinity.
  bool clamp = true;
};

/// Polygons that were looked at, and those that the line meets.
struct CrossingCounts {
  std::size_t tested = 0, crossed = 0;
};

class VolumeCounter {
 public:
  /// For receivers that are present and in front of the light. Cost O(polygons log polygons), on the calling
  /// arena's threads.
  VolumeCounter(const VolumePolygons& polygons, const AreaLight& light, const Receivers& receivers,
                const CounterOptions& options);

  /// Volumes around a receiver: faces between it and the light's center. What lies in the plane of a face, as
  /// far as double can tell, is outside of that face's volume (side_of_plane). Cost O(log polygons), and
  /// O(polygons near the line).
  int volumes_around(const RayStart& start, CrossingCounts& counts) const;
  /// Polygons that receivers may meet.
  std::size_t caps() const { return caps_; }
  std::size_t sides() const { return sides_; }

 private:
  /// Across the line, and along it.
  struct Box {
    std::array<double, 3> low, high;
    void add(const Box& other);
  };
  struct Item {
    std::array<double, 3> at;
    Box box;
    std::uint32_t polygon;  ///< below caps_: a cap
  };

  Vec3 across(const Vec3& p) const;
  Box box_around(std::initializer_list<Vec3> points) const;
  void stretch(Box& box, const Vec3& end) const;
  bool clamp_side(const VolumeSide& side, bool clamp, Box& box) const;
  void add_item(Box box, std::uint32_t polygon);
  void build();
  int crossing(const VolumeCap& cap, const RayStart& start) const;
  int crossing(const VolumeSide& side, const Vec3& x) const;

  static constexpr std::size_t kLeaf = 4;  // speed: polygons a leaf

  const AreaLight light_;
  const VolumePolygons& polygons_;
  /// The line's direction, and two across it.
  Vec3 along_, u_, v_;
  /// Of the receivers.
  Box reach_;
  double deepest_ = 0.0, margin_ = 0.0;
  /// Volumes at the far end of every line.
  int at_infinity_ = 0;
  std::size_t caps_ = 0, sides_ = 0;
  std::vector<Item> items_;
  /// From the leaves up.
  std::vector<std::vector<Box>> levels_;
};

}  // namespace penumbra::detail
