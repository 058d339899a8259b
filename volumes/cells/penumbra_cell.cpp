#include "volumes/cells/penumbra_cell.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <optional>

#include "mesh/vectors.h"
#include "volumes/cells/convex_hull.h"

namespace penumbra::detail {

namespace {

// Accuracy. Containment is held by extrude_penumbra_property_test.cpp and checks/light_poses_test.cpp.

// A body whose least depth is below this fraction of the far plane's is cut off by distance instead: the
// plane's corners would be too far out to the side.
constexpr double kLeastDepth = 1e-4;
// Beyond this ratio of the bound's distance to the body's the cell is the whole half-space in front.
constexpr double kGreatestScale = 1e7;
// The polygon is larger than circumscribed by these, relative to the light and to the cell's largest
// coordinate. So containment survives the rounding of its corners and of far points, which is some 2^-52 of
// the coordinates, seen at the angle of the ray.
constexpr double kLightMargin = 1e-9, kRoundingMargin = 1e-14;
// A vertex is left out of the far end's outline where its far disk is inside by more than this fraction of
// the outline's size: far above rounding.
constexpr double kWellInside = 1e-9;
// Edges of the outline that are shorter than this fraction of its size are left out: together they are far
// below kWellInside.
constexpr double kNoEdge = 1e-13;

// Speed. They change which vertices and faces a cell has, never what it contains within the bound.

// Bodies with up to this many vertices keep them all.
constexpr std::size_t kFewVertices = 12;
// Directions in which the outline of a larger body is searched for.
constexpr int kDirections = 48;
// How far beyond the far plane the point lies that keeps the far end from being flat, relative to the cell's
// height.
constexpr double kDome = 0.05;

/// What the choice of the far end depends on.
struct BodyExtent {
  double least_depth = std::numeric_limits<double>::infinity(), greatest_depth = 0.0;
  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;  ///< heights
  double width = 0.0;  ///< of the body, from its first point
  double largest_coordinate = 0.0;
  double greatest_distance = 0.0;  ///< from the light's center; for a distant light 1, as is depth
  double least_offset = 0.0;  ///< a lower bound of the distance from the axis of a light that is not distant
};

/// Distance from the origin to the convex polygon with these corners in order, in the plane. 0 inside.
double distance_from_origin(std::span<const std::array<double, 2>> corners) {
  double least = std::numeric_limits<double>::infinity();
  int turns = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const auto [ax, ay] = corners[i];
    const auto [bx, by] = corners[(i + 1) % corners.size()];
    const double ex = bx - ax, ey = by - ay, ee = ex * ex + ey * ey;
    const double t = ee > 0.0 ? std::clamp(-(ax * ex + ay * ey) / ee, 0.0, 1.0) : 0.0;
    least = std::min(least, std::hypot(ax + t * ex, ay + t * ey));
    turns += ax * by - ay * bx > 0.0 ? 1 : -1;
  }
  return static_cast<std::size_t>(std::abs(turns)) == corners.size() ? 0.0 : least;
}

BodyExtent extent_of(std::span<const Vec3> body, const ShadowReach& reach) {
  constexpr std::size_t kPolygonCorners =
      4;  // a triangle clipped once; larger bodies are taken to reach the axis
  const bool has_axis = !reach.light.is_distant() && body.size() <= kPolygonCorners;
  BodyExtent e;
  std::vector<std::array<double, 2>> seen;
  for (const Vec3& p : body) {
    const Vec3 d = reach.from_center(p);
    const double depth = reach.depth(p), height = reach.height(p);
    e.least_depth = std::min(e.least_depth, depth);
    e.greatest_depth = std::max(e.greatest_depth, depth);
    e.lowest = std::min(e.lowest, height);
    e.highest = std::max(e.highest, height);
    e.width = std::max(e.width, glm::length(p - body.front()));
    e.largest_coordinate = std::max(e.largest_coordinate, largest_component(p));
    e.greatest_distance = std::max(e.greatest_distance, glm::length(d));
    if (has_axis) seen.push_back({glm::dot(reach.frame.u, d), glm::dot(reach.frame.v, d)});
  }
  if (has_axis) e.least_offset = distance_from_origin(seen);
  return e;
}

/// Of the plane at which a cell is cut off: beyond the bound, and beyond the body by its own size.
double far_height_of(const BodyExtent& extent, const ShadowReach& reach) {
  return std::max(reach.far_height, extent.highest + extent.width);
}

bool is_deep(const BodyExtent& extent, const ShadowReach& reach) {
  const double far_depth = extent.least_depth + (far_height_of(extent, reach) - extent.lowest);
  return reach.light.is_distant() ||
         extent.least_depth >= kLeastDepth * std::max(far_depth, 2.0 * extent.greatest_depth);
}

/// Points of one cell: the body first, then those of its far end.
struct CellPoints {
  std::vector<Vec3> points;
  std::size_t body_count;
};

/// The polygon's corners, from the light's center.
std::vector<Vec3> light_corners(const ShadowReach& reach, const UnitPolygon& polygon, double inradius) {
  if (reach.light.radius == 0.0) return {Vec3(0.0)};
  std::vector<Vec3> corners;
  corners.reserve(polygon.corners.size());
  for (const auto& [x, y] : polygon.corners) {
    corners.push_back(inradius * (x * reach.frame.u + y * reach.frame.v));
  }
  return corners;
}

/// Where a vertex of the body sends the light on the far plane: a disk (the polygon is between it and its
/// circumcircle).
struct FarDisk {
  double x, y,
      scale;  ///< center along u and v from that of the first vertex, and by how much the light grows
};

/// Which vertices of a large body can be on the outline of its far end. A support point in each of some
/// directions gives a polygon inside of the far end's hull; a vertex whose whole far disk is well inside of
/// that polygon adds nothing.
std::vector<Vec3> outline_vertices(std::span<const Vec3> body, const ShadowReach& reach, double far_height,
                                   double inradius, double circumradius) {
  if (body.size() <= kFewVertices) return {body.begin(), body.end()};

  std::vector<FarDisk> disks;
  const auto gain_of = [&](const Vec3& k) { return far_height - reach.height(k); };
  const Vec3 first = gain_of(body.front()) * reach.ray(body.front(), Vec3(0.0));
  for (const Vec3& k : body) {
    const double gain = gain_of(k);
    const Vec3 d = (k - body.front()) + (gain * reach.ray(k, Vec3(0.0)) - first);
    disks.push_back({glm::dot(reach.frame.u, d), glm::dot(reach.frame.v, d), gain / reach.depth(k)});
  }
  std::vector<std::array<double, 2>> inner;
  double size = 0.0;
  for (int i = 0; i < kDirections; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kDirections, x = std::cos(angle), y = std::sin(angle);
    const auto support = [&](const FarDisk& d) { return x * d.x + y * d.y + d.scale * inradius; };
    const FarDisk& d = *std::max_element(disks.begin(), disks.end(), [&](const FarDisk& a, const FarDisk& b) {
      return support(a) < support(b);
    });
    inner.push_back({d.x + x * d.scale * inradius, d.y + y * d.scale * inradius});
    size = std::max({size, std::abs(inner.back()[0]), std::abs(inner.back()[1])});
  }
  const auto is_well_inside = [&](const FarDisk& d) {
    const double room = d.scale * circumradius + kWellInside * size;
    int edges = 0;
    for (int i = 0; i < kDirections; ++i) {
      const auto [ax, ay] = inner[i];
      const auto [bx, by] = inner[(i + 1) % kDirections];
      const double ex = bx - ax, ey = by - ay, length = std::hypot(ex, ey);
      if (length < kNoEdge * size) continue;
      ++edges;
      if (ex * (d.y - ay) - ey * (d.x - ax) < room * length) return false;
    }
    return edges >= 3;
  };
  std::vector<Vec3> kept;
  for (std::size_t i = 0; i < body.size(); ++i) {
    if (!is_well_inside(disks[i])) kept.push_back(body[i]);
  }
  return kept;
}

/// Cut off by a plane parallel to the light. One more point, a little beyond, keeps the far end from being
/// flat: its triangulation then needs no exact arithmetic.
CellPoints cut_by_depth(std::span<const Vec3> body, const ShadowReach& reach, const UnitPolygon& polygon,
                        const BodyExtent& extent) {
  const double far_height = far_height_of(extent, reach);
  const double whole = far_height - extent.lowest, gain = far_height - extent.highest;
  // A ray runs at most `slant` for each unit of height, so far points are off by a few 2^-53 of `size`.
  // Moving the light's corner by `margin` moves them by margin · gain / depth in a plane parallel to the
  // light, which is by that over `slant` across the ray.
  const double slant = 1.0 + (extent.greatest_distance + reach.light.radius) / extent.least_depth;
  const double size = extent.largest_coordinate + whole * slant;
  const double margin = kRoundingMargin * size * slant * (extent.greatest_depth / gain);
  const double inradius = reach.light.radius * (1.0 + kLightMargin) + margin;
  const std::vector<Vec3> corners = light_corners(reach, polygon, inradius);
  const std::vector<Vec3> outline =
      outline_vertices(body, reach, far_height, inradius, inradius * polygon.circumradius);
  CellPoints cell{{body.begin(), body.end()}, body.size()};
  cell.points.reserve(body.size() + outline.size() * corners.size() + 1);
  for (const Vec3& k : outline) {
    const double scale = (far_height - reach.height(k)) / reach.depth(k);
    const Vec3 way = reach.from_center(k);
    for (const Vec3& q : corners) cell.points.push_back(k + scale * (way - q));
  }
  Vec3 middle(0.0);
  for (const Vec3& k : body) middle += (k - body.front()) / static_cast<double>(body.size());
  middle += body.front();
  const double dome = far_height - reach.height(middle) + kDome * whole;
  cell.points.push_back(middle + dome * reach.ray(middle, Vec3(0.0)));
  return cell;
}

/// Cut off by distance: S times the body's. The polygon becomes a thin prism, since rays that graze the
/// light's plane are not moved across their direction by a wider polygon. Nothing where S would be too large.
std::optional<CellPoints> cut_by_distance(std::span<const Vec3> body, const ShadowReach& reach,
                                          const UnitPolygon& polygon, const BodyExtent& extent) {
  const double thickness =
      100.0 * kRoundingMargin * (extent.largest_coordinate + extent.greatest_distance + reach.light.radius);
  const double inradius = reach.light.radius * (1.0 + kLightMargin) + thickness;
  const double offset = std::max(0.0, extent.least_offset - inradius * polygon.circumradius);
  const double nearest = std::hypot(std::max(0.0, extent.least_depth), offset) - 2.0 * thickness;
  const double scale = std::max(2.0, (reach.distance() + inradius * polygon.circumradius) / nearest);
  if (!(nearest > 0.0) || !(scale <= kGreatestScale)) return std::nullopt;

  CellPoints cell{{body.begin(), body.end()}, body.size()};
  for (const Vec3& corner : light_corners(reach, polygon, inradius)) {
    for (const double side : {-thickness, thickness}) {
      const Vec3 q = corner + side * reach.frame.w;
      for (const Vec3& k : body) cell.points.push_back(k + (scale - 1.0) * (reach.from_center(k) - q));
    }
  }
  return cell;
}

/// The half-space in front of the light as far as the bound: for bodies that (almost) touch the disk.
CellPoints half_space(const ShadowReach& reach, const BodyExtent& extent) {
  const double far = std::max({reach.distance(), extent.greatest_distance, reach.light.radius}) * 2.0;
  const double behind = -1e-12 * (far + largest_component(reach.light.center));
  CellPoints cell{{}, 0};
  for (const double z : {behind, far}) {
    for (const double y : {-far, far}) {
      for (const double x : {-far, far}) {
        cell.points.push_back(reach.light.center + x * reach.frame.u + y * reach.frame.v + z * reach.frame.w);
      }
    }
  }
  return cell;
}

Cell hull_of(const CellPoints& input) {
  Cell cell;
  cell.triangles = convex_hull(input.points);
  cell.kinds.reserve(cell.triangles.size());
  std::vector<std::uint32_t> number(input.points.size(), std::numeric_limits<std::uint32_t>::max());
  for (IndexedTriangle& t : cell.triangles) {
    const bool far = std::all_of(t.begin(), t.end(), [&](std::uint32_t i) { return i >= input.body_count; });
    cell.kinds.push_back(far && input.body_count > 0 ? ShadowKind::kFarCap : ShadowKind::kCell);
    for (std::uint32_t& corner : t) {
      if (number[corner] == std::numeric_limits<std::uint32_t>::max()) {
        number[corner] = static_cast<std::uint32_t>(cell.positions.size());
        cell.positions.push_back(input.points[corner]);
      }
      corner = number[corner];
    }
  }
  return cell;
}

}  // namespace

UnitPolygon::UnitPolygon(int count) : circumradius(1.0 / std::cos(std::numbers::pi / count)) {
  for (int i = 0; i < count; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / count;
    corners.push_back({circumradius * std::cos(angle), circumradius * std::sin(angle)});
  }
}

bool is_cut_by_depth(std::span<const Vec3> body, const ShadowReach& reach) {
  return is_deep(extent_of(body, reach), reach);
}

Cell make_penumbra_cell(std::span<const Vec3> body, const ShadowReach& reach, const UnitPolygon& polygon) {
  const BodyExtent extent = extent_of(body, reach);
  if (is_deep(extent, reach)) return hull_of(cut_by_depth(body, reach, polygon, extent));
  if (const auto points = cut_by_distance(body, reach, polygon, extent)) return hull_of(*points);
  return hull_of(half_space(reach, extent));
}

}  // namespace penumbra::detail
