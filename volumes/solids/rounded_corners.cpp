#include "volumes/solids/rounded_corners.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <set>
#include <utility>

#include "mesh/vectors.h"

namespace penumbra::detail {
namespace {

/// Of the largest coordinate. A corner of rounded planes that meet at good angles is off by some units of
/// 2^-53; a millionth of a millimeter in a kilometer is far less than any tolerance.
constexpr double kRounding = 0x1p-44;

/// For each vertex the first one that it is not told apart from.
std::vector<std::uint32_t> representatives(const std::vector<Vec3>& positions) {
  double largest = 0.0;
  for (const Vec3& p : positions) largest = std::max(largest, largest_component(p));
  const double distance = kRounding * largest;
  std::vector<std::uint32_t> order(positions.size()), first(positions.size());
  std::iota(order.begin(), order.end(), 0u);
  std::iota(first.begin(), first.end(), 0u);
  std::ranges::sort(order, {}, [&](std::uint32_t i) { return positions[i].x; });
  for (std::size_t i = 0; i < order.size(); ++i)
    for (std::size_t k = i + 1; k < order.size(); ++k) {
      const Vec3 d = positions[order[k]] - positions[order[i]];
      if (d.x > distance) break;
      if (largest_component(d) > distance) continue;
      const std::uint32_t kept = std::min(first[order[i]], first[order[k]]);
      first[order[i]] = first[order[k]] = kept;
    }
  for (std::uint32_t& f : first) f = first[f];
  return first;
}

bool is_a_sphere(const SolidMesh& mesh) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  std::set<std::uint32_t> vertices;
  for (const IndexedTriangle& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) {
      vertices.insert(t[k]);
      if (!edges.emplace(t[k], t[(k + 1) % 3]).second) return false;
    }
  for (const auto& [from, to] : edges)
    if (!edges.contains({to, from})) return false;
  return vertices.size() + mesh.triangles.size() == edges.size() / 2 + 2;
}

/// Without vertices that no triangle has.
void compact(SolidMesh& mesh) {
  constexpr auto kUnused = static_cast<std::uint32_t>(-1);
  std::vector<std::uint32_t> place(mesh.positions.size(), kUnused);
  std::vector<Vec3> positions;
  for (IndexedTriangle& t : mesh.triangles)
    for (std::uint32_t& v : t) {
      if (place[v] == kUnused) {
        place[v] = static_cast<std::uint32_t>(positions.size());
        positions.push_back(mesh.positions[v]);
      }
      v = place[v];
    }
  mesh.positions = std::move(positions);
}

}  // namespace

void merge_rounded_corners(SolidMesh& mesh) {
  const std::vector<std::uint32_t> first = representatives(mesh.positions);
  SolidMesh merged;
  merged.positions = mesh.positions;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    IndexedTriangle t = mesh.triangles[i];
    for (std::uint32_t& v : t) v = first[v];
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
    merged.triangles.push_back(t);
    merged.is_cap.push_back(mesh.is_cap[i]);
  }
  if (merged.triangles.size() == mesh.triangles.size() || !is_a_sphere(merged)) return;
  compact(merged);
  mesh = std::move(merged);
}

}  // namespace penumbra::detail
