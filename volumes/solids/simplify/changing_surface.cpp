#include "volumes/solids/simplify/changing_surface.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <numeric>

namespace penumbra::detail {
namespace {

constexpr double kRounding = 1e-13;  ///< of the surface's size

}  // namespace

ChangingSurface::ChangingSurface(IndexedSurface surface, const SimplifyOptions& simplify_options)
    : options(simplify_options),
      positions(std::move(surface.positions)),
      triangles(std::move(surface.triangles)),
      faces_at(positions.size()),
      quadrics(positions.size()),
      errors(positions.size(), 0.0),
      on_side(positions.size(), 0),
      version(positions.size(), 0),
      became(positions.size()) {
  std::iota(became.begin(), became.end(), 0u);
  const Bounds all = bounds_of(positions);
  origin = all.center();
  rounding = kRounding * all.radius();
  for (std::uint32_t f = 0; f < triangles.size(); ++f) {
    const std::array<Vec3, 3> c = corners(triangles[f]);
    const Vec3 n = glm::cross(c[1] - c[0], c[2] - c[0]);
    const double twice = glm::length(n);
    for (const std::uint32_t v : triangles[f]) {
      faces_at[v].push_back(f);
      if (twice > 0.0) quadrics[v].add_plane(n / twice, c[0] - origin, twice);
    }
  }
  for (std::size_t v = 0; v < positions.size(); ++v)
    for (int k = 0; k < 3; ++k) {
      if (positions[v][k] == options.box.low[k]) on_side[v] |= static_cast<std::uint8_t>(1 << k);
      if (positions[v][k] == options.box.high[k]) on_side[v] |= static_cast<std::uint8_t>(8 << k);
    }
}

bool ChangingSurface::is_edge(std::uint32_t a, std::uint32_t b) const {
  return std::ranges::any_of(faces_at[a], [&](std::uint32_t f) { return has(triangles[f], b); });
}

void ChangingSurface::collapse(std::uint32_t a, std::uint32_t b, const Vec3& point, double error) {
  positions[a] = point;
  errors[a] = error;
  quadrics[a] += quadrics[b];
  on_side[a] |= on_side[b];
  for (const std::uint32_t f : faces_at[b]) {
    IndexedTriangle& t = triangles[f];
    if (has(t, a)) {
      for (const std::uint32_t v : t)
        if (v != b) std::erase(faces_at[v], f);
      t = {kGone, kGone, kGone};
      continue;
    }
    for (std::uint32_t& v : t)
      if (v == b) v = a;
    faces_at[a].push_back(f);
  }
  faces_at[b].clear();
  became[b] = a;
  ++version[a];
}

IndexedSurface ChangingSurface::result() const {
  IndexedSurface out;
  std::vector<std::uint32_t> number(positions.size(), kGone);
  for (const IndexedTriangle& t : triangles) {
    if (t[0] == kGone) continue;
    IndexedTriangle named;
    for (int k = 0; k < 3; ++k) {
      std::uint32_t& n = number[t[k]];
      if (n == kGone) {
        n = static_cast<std::uint32_t>(out.positions.size());
        out.positions.push_back(positions[t[k]]);
      }
      named[k] = n;
    }
    out.triangles.push_back(named);
  }
  return out;
}

}  // namespace penumbra::detail
