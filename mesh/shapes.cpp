#include "penumbra/mesh/shapes.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>
#include <unordered_map>

namespace penumbra {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

/// Index of the point midway on the unit sphere between a and b, made when first asked for.
class Midpoints {
 public:
  explicit Midpoints(std::vector<Vec3>& points) : points_(points) {}

  std::uint32_t between(std::uint32_t a, std::uint32_t b) {
    const auto [low, high] = std::minmax(a, b);
    const auto [entry, is_new] = made_.try_emplace((std::uint64_t{low} << 32) | high, points_.size());
    if (is_new) {
      points_.push_back(glm::normalize(points_[low] + points_[high]));
    }
    return entry->second;
  }

 private:
  std::vector<Vec3>& points_;
  std::unordered_map<std::uint64_t, std::uint32_t> made_;
};

/// Numbers in [-1, 1) that are the same with every standard library, unlike std::uniform_real_distribution.
class Uniform {
 public:
  explicit Uniform(std::uint64_t seed) : engine_(seed) {}

  /// In the shell inner² < |p|² <= 1.
  Vec3 in_ball(double inner_squared) {
    for (;;) {
      const double x = next(), y = next(), z = next();
      const double squared = x * x + y * y + z * z;
      if (inner_squared < squared && squared <= 1.0) {
        return {x, y, z};
      }
    }
  }

 private:
  double next() { return static_cast<double>(engine_() >> 11) * 0x1p-52 - 1.0; }
  std::mt19937_64 engine_;
};

}  // namespace

TriangleMesh make_triangle(const Vec3& a, const Vec3& b, const Vec3& c) {
  const std::array<Vec3, 3> positions = {a, b, c};
  const IndexedTriangle triangle = {0, 1, 2};
  return TriangleMesh::build(positions, {&triangle, 1});
}

TriangleMesh make_plane(double half, int segments) {
  assert(segments >= 1);
  const auto n = static_cast<std::uint32_t>(segments);
  std::vector<Vec3> positions;
  std::vector<IndexedTriangle> triangles;
  for (std::uint32_t i = 0; i <= n; ++i) {
    for (std::uint32_t j = 0; j <= n; ++j) {
      positions.emplace_back(half * (2.0 * i / n - 1.0), 0.0, half * (2.0 * j / n - 1.0));
    }
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t j = 0; j < n; ++j) {
      const std::uint32_t a = i * (n + 1) + j, b = a + n + 1;
      triangles.push_back({a, a + 1, b + 1});
      triangles.push_back({a, b + 1, b});
    }
  }
  return TriangleMesh::build(positions, triangles);
}

TriangleMesh make_box(const Vec3& center, const Vec3& half) {
  std::vector<Vec3> positions;
  for (const double x : {-1.0, 1.0}) {
    for (const double y : {-1.0, 1.0}) {
      for (const double z : {-1.0, 1.0}) {
        positions.push_back(center + half * Vec3(x, y, z));
      }
    }
  }
  static constexpr std::array<IndexedTriangle, 12> kTriangles = {{{0, 1, 3},
                                                                  {0, 3, 2},
                                                                  {4, 6, 7},
                                                                  {4, 7, 5},
                                                                  {0, 4, 5},
                                                                  {0, 5, 1},
                                                                  {2, 3, 7},
                                                                  {2, 7, 6},
                                                                  {0, 2, 6},
                                                                  {0, 6, 4},
                                                                  {1, 5, 7},
                                                                  {1, 7, 3}}};
  return TriangleMesh::build(positions, kTriangles);
}

TriangleMesh make_icosphere(const Vec3& center, double radius, int levels) {
  assert(levels >= 0);
  const double g = std::numbers::phi;
  std::vector<Vec3> points = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                              {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  std::vector<IndexedTriangle> triangles = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                                            {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                                            {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                                            {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
  for (Vec3& p : points) {
    p = glm::normalize(p);
  }
  for (int level = 0; level < levels; ++level) {
    Midpoints midpoints(points);
    std::vector<IndexedTriangle> finer;
    finer.reserve(4 * triangles.size());
    for (const auto& [a, b, c] : triangles) {
      const std::uint32_t ab = midpoints.between(a, b), bc = midpoints.between(b, c),
                          ca = midpoints.between(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
    }
    triangles = std::move(finer);
  }
  for (Vec3& p : points) {
    p = center + radius * p;
  }
  return TriangleMesh::build(points, triangles);
}

TriangleMesh make_torus(const Vec3& center, double ring_radius, double tube_radius, int ring_segments,
                        int tube_segments) {
  assert(ring_segments >= 3 && tube_segments >= 3);
  const auto n = static_cast<std::uint32_t>(ring_segments), k = static_cast<std::uint32_t>(tube_segments);
  std::vector<Vec3> positions;
  std::vector<IndexedTriangle> triangles;
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t j = 0; j < k; ++j) {
      const double a = kTurn * i / n, b = kTurn * j / k;
      const double distance = ring_radius + tube_radius * std::cos(b);
      positions.push_back(center +
                          Vec3(distance * std::cos(a), tube_radius * std::sin(b), distance * std::sin(a)));
    }
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t j = 0; j < k; ++j) {
      const std::uint32_t next_i = (i + 1) % n, next_j = (j + 1) % k;
      const std::uint32_t a = i * k + j, b = next_i * k + j, c = next_i * k + next_j, d = i * k + next_j;
      triangles.push_back({a, c, b});
      triangles.push_back({a, d, c});
    }
  }
  return TriangleMesh::build(positions, triangles);
}

TriangleMesh make_cylinder(const Vec3& center, double radius, double half_height, int segments) {
  assert(segments >= 3);
  const auto n = static_cast<std::uint32_t>(segments);
  std::vector<Vec3> positions = {center - Vec3(0, half_height, 0), center + Vec3(0, half_height, 0)};
  std::vector<IndexedTriangle> triangles;
  for (std::uint32_t i = 0; i < n; ++i) {
    const double x = radius * std::cos(kTurn * i / n), z = radius * std::sin(kTurn * i / n);
    positions.push_back(center + Vec3(x, -half_height, z));
    positions.push_back(center + Vec3(x, half_height, z));
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t low = 2 + 2 * i, high = low + 1, next_low = 2 + 2 * ((i + 1) % n),
                        next_high = next_low + 1;
    triangles.push_back({0, low, next_low});
    triangles.push_back({1, next_high, high});
    triangles.push_back({low, high, next_high});
    triangles.push_back({low, next_high, next_low});
  }
  return TriangleMesh::build(positions, triangles);
}

TriangleMesh make_random_triangles(const Vec3& center, double radius, double triangle_size, int count,
                                   std::uint64_t seed) {
  assert(count >= 0);
  constexpr double kInnerSquared = 0.3;  // corners keep away from the center, so slivers are few
  Uniform uniform(seed);
  std::vector<Vec3> positions;
  std::vector<IndexedTriangle> triangles;
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(count); ++i) {
    const Vec3 middle = center + radius * uniform.in_ball(-1.0);
    for (int k = 0; k < 3; ++k) {
      positions.push_back(middle + triangle_size * uniform.in_ball(kInnerSquared));
    }
    triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  return TriangleMesh::build(positions, triangles, {.weld = false});
}

}  // namespace penumbra
