#include "mesh/polygons/polygon_triangles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "mesh/polygons/plane_triangulation.h"
#include "mesh/vectors.h"

namespace penumbra::detail {
namespace {

/// The corners times a power of two that brings them into [-1, 1]: nothing is rounded, nothing overflows.
std::vector<Vec3> scaled_exactly(std::span<const Vec3> corners) {
  double largest = 0.0;
  for (const Vec3& p : corners) largest = std::max(largest, largest_component(p));
  const int exponent = largest > 0.0 ? -std::ilogb(largest) - 1 : 0;
  std::vector<Vec3> scaled;
  scaled.reserve(corners.size());
  for (const Vec3& p : corners)
    scaled.emplace_back(std::ldexp(p.x, exponent), std::ldexp(p.y, exponent), std::ldexp(p.z, exponent));
  return scaled;
}

/// The axis that the area vector leans to most, then others that it leans to at least an eighth as much.
std::vector<int> axes_by_area(const std::vector<Vec3>& corners) {
  Vec3 area(0.0);
  for (std::size_t i = 2; i < corners.size(); ++i)
    area += glm::cross(corners[i - 1] - corners[0], corners[i] - corners[0]);
  std::vector<int> axes = {2, 1, 0};
  std::ranges::stable_sort(axes, [&](int a, int b) { return std::abs(area[a]) > std::abs(area[b]); });
  std::erase_if(axes, [&](int axis) { return std::abs(area[axis]) < 0.125 * std::abs(area[axes[0]]); });
  return axes;
}

std::vector<Vec2> seen_along(int axis, const std::vector<Vec3>& corners) {
  std::vector<Vec2> seen;
  seen.reserve(corners.size());
  for (const Vec3& p : corners) seen.emplace_back(p[(axis + 1) % 3], p[(axis + 2) % 3]);
  return seen;
}

std::vector<IndexedTriangle> fan(std::size_t size) {
  std::vector<IndexedTriangle> triangles;
  for (std::uint32_t k = 2; k < size; ++k) triangles.push_back({0, k - 1, k});
  return triangles;
}

bool are_on_one_line(const std::vector<Vec2>& p) {
  std::size_t other = 1;
  while (other < p.size() && p[other] == p[0]) ++other;
  for (std::size_t k = other + 1; k < p.size(); ++k)
    if (orientation(p[0], p[other], p[k]) != 0) return false;
  return true;
}

/// The fan's triangles run one way and together go less than once round the first corner. It is not asked
/// where another corner returns to the first.
bool is_fan_right(const std::vector<Vec2>& p) {
  std::size_t first = 1, last = p.size() - 1;
  while (first < last && p[first] == p[0]) ++first;
  while (first < last && p[last] == p[0]) --last;
  int way = 0;
  bool beyond = false;  // the rays to the corners have left the half-plane that they began in
  for (std::size_t k = first; k <= last; ++k) {
    if (p[k] == p[0]) return false;
    const int step = k == first ? 0 : orientation(p[0], p[k - 1], p[k]);
    if (step != 0 && way != 0 && step != way) return false;
    if (way == 0) way = step;
    const int side = way * orientation(p[0], p[first], p[k]);
    if (beyond && side >= 0) return false;
    beyond = beyond || side < 0;
  }
  return true;
}

/// Whether two corners turn opposite ways.
bool turns_both_ways(const std::vector<Vec2>& p) {
  bool left = false, right = false;
  for (std::size_t i = 0, before = p.size() - 1, after = 1; i < p.size(); ++i) {
    while (after < i + p.size() && p[after % p.size()] == p[i]) ++after;
    if (after == i + p.size()) return false;  // all corners are one point
    if (p[before] == p[i]) continue;
    const int turn = orientation(p[before], p[i], p[after % p.size()]);
    left = left || turn > 0;
    right = right || turn < 0;
    before = i;
  }
  return left && right;
}

/// The points that corners are at, each once, with the first corner there.
struct Places {
  std::vector<Vec2> points;
  std::vector<std::uint32_t> corner;     ///< of each point
  std::vector<std::uint32_t> of_corner;  ///< the point of each corner
};

/// Nothing where corners at different places in space are seen at one point.
std::optional<Places> find_places(const std::vector<Vec2>& seen, const std::vector<Vec3>& corners) {
  std::vector<std::uint32_t> order(seen.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  const auto key = [&](std::uint32_t i) { return std::pair(seen[i].x, seen[i].y); };
  std::ranges::stable_sort(order, {}, key);
  std::vector<std::uint32_t> first(seen.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool again = i > 0 && key(order[i]) == key(order[i - 1]);
    first[order[i]] = again ? first[order[i - 1]] : order[i];
    if (corners[order[i]] != corners[first[order[i]]]) return std::nullopt;
  }
  Places places;
  places.of_corner.resize(seen.size());
  for (std::uint32_t i = 0; i < seen.size(); ++i) {
    if (first[i] == i) {
      places.of_corner[i] = static_cast<std::uint32_t>(places.points.size());
      places.points.push_back(seen[i]);
      places.corner.push_back(i);
    } else {
      places.of_corner[i] = places.of_corner[first[i]];
    }
  }
  return places;
}

std::optional<std::vector<IndexedTriangle>> divide_seen(const std::vector<Vec2>& seen,
                                                        const std::vector<Vec3>& corners) {
  const std::optional<Places> places = find_places(seen, corners);
  if (!places) return std::nullopt;
  std::optional<std::vector<IndexedTriangle>> triangles = triangulate_line(places->points, places->of_corner);
  if (triangles)
    for (IndexedTriangle& t : *triangles)
      for (std::uint32_t& v : t) v = places->corner[v];
  return triangles;
}

}  // namespace

PolygonTriangles divide_polygon(std::span<const Vec3> corners) {
  if (corners.size() <= 3) return {.triangles = fan(corners.size())};
  const std::vector<Vec3> scaled = scaled_exactly(corners);
  bool has_area = false;
  for (const int axis : axes_by_area(scaled)) {
    const std::vector<Vec2> seen = seen_along(axis, scaled);
    if (are_on_one_line(seen)) continue;
    has_area = true;
    const bool is_concave = turns_both_ways(seen);
    if (is_fan_right(seen)) return {.triangles = fan(corners.size()), .is_concave = is_concave};
    if (auto triangles = divide_seen(seen, scaled))
      return {.triangles = std::move(*triangles), .is_concave = is_concave};
  }
  return {.triangles = fan(corners.size()), .is_concave = has_area, .crosses_itself = has_area};
}

}  // namespace penumbra::detail
