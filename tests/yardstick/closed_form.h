// The area that a polygon covers of a disk, in closed form.
#pragma once

#include <span>
#include <vector>

#include "penumbra/mesh/types.h"
#include "penumbra/volumes/disk_light.h"

namespace penumbra::yardstick {

struct Point {
  double x = 0.0, y = 0.0;
};

/// The area of the part of a polygon that lies in the unit disk about the origin; of either sign, by the
/// polygon's sense.
///
/// It is the sum over the edges of the area of triangle (0, p, q) within the disk (Green): where the edge
/// runs inside the disk half the cross product of the ends, where it runs outside half the angle that it is
/// seen under.
double area_in_unit_disk(std::span<const Point> polygon);

/// Where points are seen from x: their places on the light's unit disk. They must lie in front of x towards
/// the light and, for a near disk, between x and its plane.
std::vector<Point> seen_on_light(const DiskLight& light, const Vec3& x, std::span<const Vec3> points);
std::vector<Point> seen_on_light(const DistantLight& light, const Vec3& x, std::span<const Vec3> points);

}  // namespace penumbra::yardstick
