// Inputs by chance for the tests of the oracle.
#pragma once

#include <array>
#include <cmath>
#include <random>

#include "penumbra/mesh/triangle_mesh.h"

namespace penumbra::oracle {

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  int integer(int low, int high) { return std::uniform_int_distribution<int>(low, high)(engine_); }
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  Vec3 lattice(int size) { return Vec3(integer(-size, size), integer(-size, size), integer(-size, size)); }
  Vec3 point(double size) { return {uniform(-size, size), uniform(-size, size), uniform(-size, size)}; }
  /// Moves one coordinate to the next number, up or down.
  void nudge(Vec3& p) {
    double& a = p[integer(0, 2)];
    a = std::nextafter(a, integer(0, 1) ? 1e300 : -1e300);
  }

 private:
  std::mt19937_64 engine_;
};

inline std::array<Vec3, 3> corners_of(const TriangleMesh& mesh, std::size_t face) {
  const IndexedTriangle& t = mesh.triangles()[face];
  return {mesh.positions()[t[0]], mesh.positions()[t[1]], mesh.positions()[t[2]]};
}

}  // namespace penumbra::oracle
