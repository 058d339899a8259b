// Random casters and lights for solids: bodies and loose triangles that touch, cross and enclose each other,
// lights near, far and infinitely far, some of them in the middle of it all.
#pragma once

#include <glm/geometric.hpp>
#include <random>
#include <vector>

#include "penumbra/mesh/shapes.h"
#include "penumbra/render/light/light.h"

namespace penumbra {

struct RandomSolidScene {
  explicit RandomSolidScene(std::uint64_t seed) : random_(seed) {
    const int count = 1 + static_cast<int>(4.0 * unit());
    for (int i = 0; i < count; ++i) casters.push_back(caster());
    const Vec3 normal = Vec3(0.0, -1.0, 0.0) + any(1.5);
    const double kind = unit();
    if (kind < 0.25) {
      light = DistantLight{normal, 30.0 * unit() * unit()};
    } else {
      const double far = kind < 0.4 ? 0.3 : kind < 0.8 ? 3.0 : std::pow(10.0, 1.0 + 4.0 * unit());
      light = DiskLight{-far / glm::length(normal) * normal + any(0.3), normal,
                        far * (0.02 + 0.5 * unit() * unit())};
    }
  }

  std::vector<TriangleMesh> casters;
  LightShape light;

 private:
  double unit() { return std::uniform_real_distribution<double>(0.0, 1.0)(random_); }
  Vec3 any(double size) { return size * Vec3(unit() - 0.5, unit() - 0.5, unit() - 0.5); }
  TriangleMesh caster() {
    const Vec3 center = any(1.0);
    const double size = 0.1 + 0.4 * unit();
    switch (static_cast<int>(6.0 * unit())) {
      case 0:
        return make_box(center, size * (Vec3(0.6) + any(1.0)));
      case 1:
        return make_icosphere(center, size, 2);
      case 2:
        return make_torus(center, size, 0.4 * size, 20, 10);
      case 3:
        return make_cylinder(center, 0.3 * size, size, 12);
      case 4:
        return make_triangle(center + any(1.0), center + any(1.0), center + any(1.0));
      default:
        return make_random_triangles(center, size, 0.3 * size, 12, static_cast<unsigned>(1e6 * unit()));
    }
  }

  std::mt19937_64 random_;
};

}  // namespace penumbra
