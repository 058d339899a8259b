// Scenes by chance, and shapes of which there are many.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "penumbra/render/scene/scene.h"
#include "tests/oracle/random_inputs.h"

namespace penumbra::bench {

inline constexpr double kPi = std::numbers::pi;

class Random : public oracle::Random {
 public:
  using oracle::Random::point;
  using oracle::Random::Random;
  Vec3 point() { return point(1.0); }
  /// Logarithms evenly spread.
  double spread(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }
};

/// Separate triangles.
class Triangles {
 public:
  void add(const Vec3& a, const Vec3& b, const Vec3& c) {
    const auto first = static_cast<std::uint32_t>(points_.size());
    points_.insert(points_.end(), {a, b, c});
    faces_.push_back({first, first + 1, first + 2});
  }
  TriangleMesh mesh() const { return TriangleMesh::build(points_, faces_); }

 private:
  std::vector<Vec3> points_;
  std::vector<IndexedTriangle> faces_;
};

/// Triangles of about that size, strewn over 2 × 1 × 2.
TriangleMesh soup(int count, double size);
/// Blades that stand on a square of that half side.
TriangleMesh grass(int count, double half, std::uint64_t seed);
/// Spheres of 80 faces in 3 × 1.5 × 3, as one mesh.
TriangleMesh balls(int count);

/// The same seed gives the same scene.
Scene random_scene(std::uint64_t seed);

}  // namespace penumbra::bench
