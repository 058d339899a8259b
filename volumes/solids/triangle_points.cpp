#include "volumes/solids/triangle_points.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

namespace penumbra::detail {
namespace {

template <class T>
void keep_one_each(std::vector<T>& list) {
  tbb::parallel_sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

}  // namespace

PointPattern middle_points() {
  return {.corners = true, .sides = {0.5}, .inside = {{1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0}}};
}

PointPattern lattice_points(int n) {
  PointPattern out{.corners = true, .sides = {}, .inside = {}};
  for (int i = 1; i < n; ++i) {
    out.sides.push_back(static_cast<double>(i) / n);
    for (int j = 1; i + j < n; ++j)
      out.inside.push_back(
          {static_cast<double>(i) / n, static_cast<double>(j) / n, static_cast<double>(n - i - j) / n});
  }
  return out;
}

TrianglePoints::TrianglePoints(std::span<const Vec3> positions, std::span<const IndexedTriangle> triangles,
                               const PointPattern& pattern, const Known& known)
    : triangles_(triangles), pattern_(pattern), inside_(triangles.size(), kNone) {
  for (std::size_t i = 0; i < triangles.size(); ++i)
    for (unsigned k = 0; k < 3; ++k) {
      const unsigned bits = known.empty() ? 0u : known[i];
      if (pattern.corners && !(bits >> k & 1)) corners_.push_back(triangles[i][k]);
      if (!(bits >> (k + 3) & 1)) sides_.push_back(side(triangles[i], k));
    }
  keep_one_each(corners_);
  keep_one_each(sides_);
  std::size_t count = corners_.size() + pattern.sides.size() * sides_.size();
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    if (!known.empty() && (known[i] >> 6 & 1)) continue;
    inside_[i] = count;
    count += pattern.inside.size();
  }
  points_.resize(count);
  for (std::size_t i = 0; i < corners_.size(); ++i) points_[i] = positions[corners_[i]];
  tbb::parallel_for(std::size_t{0}, sides_.size(), [&](std::size_t i) {
    const Vec3 &a = positions[sides_[i][0]], &b = positions[sides_[i][1]];
    for (std::size_t s = 0; s < pattern.sides.size(); ++s)
      points_[corners_.size() + i * pattern.sides.size() + s] =
          (1.0 - pattern.sides[s]) * a + pattern.sides[s] * b;
  });
  tbb::parallel_for(std::size_t{0}, triangles.size(), [&](std::size_t i) {
    const IndexedTriangle& t = triangles[i];
    for (std::size_t p = 0; inside_[i] != kNone && p < pattern.inside.size(); ++p) {
      const auto& w = pattern.inside[p];
      points_[inside_[i] + p] = w[0] * positions[t[0]] + w[1] * positions[t[1]] + w[2] * positions[t[2]];
    }
  });
}

}  // namespace penumbra::detail
