#include "mesh/polygons/plane_triangulation.h"

#include <algorithm>
#include <map>
#include <unordered_map>
#include <utility>

#include "mesh/polygons/square_triangulation.h"

namespace penumbra::detail {
namespace {

constexpr std::uint32_t kFrame = SquareTriangulation::kFrame;
using Side = std::pair<std::uint32_t, std::uint32_t>;  ///< two points

/// How often the line runs along each piece, forth less back, and the points that it passes on the way.
struct Piece {
  int net = 0;
  std::vector<std::uint32_t> passed;  ///< from the lower vertex to the higher one
};

/// How often the line winds round each triangle; nothing where it is not once at most, and all one way.
std::optional<std::vector<int>> winding_numbers(const SquareTriangulation& plane,
                                                const std::unordered_map<std::uint64_t, int>& net) {
  constexpr int kUnknown = 2;
  std::vector<int> winding(plane.size(), kUnknown);
  std::vector<std::uint32_t> open = {plane.any_outside()};
  winding[open[0]] = 0;
  int least = 0, most = 0;
  while (!open.empty()) {
    const std::uint32_t t = open.back();
    open.pop_back();
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t u = plane.across(t, k);
      if (u == SquareTriangulation::kNoTriangle || winding[u] != kUnknown) continue;
      const std::uint32_t a = plane.triangle(t)[k], b = plane.triangle(t)[(k + 1) % 3];
      const auto found = net.find(side_key(a, b));
      const int along = found == net.end() ? 0 : a < b ? found->second : -found->second;
      winding[u] = winding[t] - along;  // t is on the left of a → b
      least = std::min(least, winding[u]);
      most = std::max(most, winding[u]);
      if (most - least > 1) return std::nullopt;
      open.push_back(u);
    }
  }
  return winding;
}

}  // namespace

std::optional<std::vector<IndexedTriangle>> triangulate_line(std::span<const Vec2> points,
                                                             std::span<const std::uint32_t> line) {
  // 1. Every piece of the line once.
  std::map<Side, Piece> pieces;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const std::uint32_t a = line[i], b = line[(i + 1) % line.size()];
    if (a != b) pieces[std::minmax(a, b)].net += a < b ? 1 : -1;
  }
  // 2. All points, all pieces.
  SquareTriangulation plane(points);
  std::unordered_map<std::uint64_t, int> net;
  for (auto& [side, piece] : pieces) {
    std::optional<std::vector<std::uint32_t>> passed = plane.insert_segment(side.first, side.second);
    if (!passed) return std::nullopt;
    std::uint32_t from = side.first;
    passed->push_back(side.second);
    for (const std::uint32_t to : *passed) {
      net[side_key(from + kFrame, to + kFrame)] += from < to ? piece.net : -piece.net;
      from = to;
    }
    passed->pop_back();
    piece.passed = std::move(*passed);
  }
  // 3. The triangles inside.
  const std::optional<std::vector<int>> winding = winding_numbers(plane, net);
  if (!winding) return std::nullopt;
  std::vector<IndexedTriangle> inside;
  for (std::uint32_t t = 0; t < plane.size(); ++t) {
    if ((*winding)[t] == 0) continue;
    auto [a, b, c] = plane.triangle(t);
    if ((*winding)[t] < 0) std::swap(b, c);
    inside.push_back({a - kFrame, b - kFrame, c - kFrame});
  }
  // 4. Triangles without area between a piece and the points on it.
  for (const auto& [side, piece] : pieces) {
    std::uint32_t far = side.second;
    for (std::size_t i = piece.passed.size(); piece.net != 0 && i > 0; --i) {
      const std::uint32_t near = piece.passed[i - 1];
      inside.push_back(piece.net > 0 ? IndexedTriangle{side.first, far, near}
                                     : IndexedTriangle{side.first, near, far});
      far = near;
    }
  }
  return inside;
}

}  // namespace penumbra::detail
