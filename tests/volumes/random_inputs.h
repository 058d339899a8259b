// Inputs for predicate tests: random, degenerate on purpose, nudged by one unit in the last place, far from
// scale 1.
#pragma once

#include <cmath>
#include <limits>
#include <random>

#include "penumbra/volumes/disk_light.h"

namespace penumbra::testing {

class RandomInputs {
 public:
  explicit RandomInputs(std::uint64_t seed) : engine_(seed) {}

  int integer(int low, int high) { return std::uniform_int_distribution<int>(low, high)(engine_); }
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  Vec3 uniform_point(double size = 1.0) {
    return {uniform(-size, size), uniform(-size, size), uniform(-size, size)};
  }
  Vec3 lattice_point(int size) {
    return Vec3(integer(-size, size), integer(-size, size), integer(-size, size));
  }
  Vec3 direction() {
    for (;;) {
      const Vec3 v = uniform_point();
      if (const double length = std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z); length > 0.1 && length < 1)
        return v / length;
    }
  }
  /// Moves one coordinate by at most two units in the last place.
  void nudge(Vec3& p) {
    double& x = p[integer(0, 2)];
    const double towards =
        integer(0, 1) ? std::numeric_limits<double>::infinity() : -std::numeric_limits<double>::infinity();
    for (int steps = integer(0, 2); steps > 0; --steps) x = std::nextafter(x, towards);
  }

 private:
  std::mt19937_64 engine_;
};

/// A light and four points about it.
struct PredicateInput {
  CircularLight light = DiskLight{};
  Vec3 p[4];
};

/// Points of a plane that touches the rim of the disk exactly: all coordinates are integers. The rim point
/// comes from a Pythagorean triple; two integer directions span the plane.
inline PredicateInput tangent_input(RandomInputs& random) {
  static constexpr int kTriples[4][3] = {{3, 4, 5}, {5, 12, 13}, {8, 15, 17}, {20, 21, 29}};
  const auto& t = kTriples[random.integer(0, 3)];
  const int sx = random.integer(0, 1) ? 1 : -1, sy = random.integer(0, 1) ? 1 : -1;
  const Vec3 rim(sx * t[0], sy * t[1], 0), along(-sy * t[1], sx * t[0], 0);
  const int l = random.integer(-3, 3), k = random.integer(1, 3);
  const Vec3 across(l * sx * t[0], l * sy * t[1], k * t[2] * t[2]);
  PredicateInput in;
  in.light = {random.lattice_point(9), Vec3(0, 0, random.integer(0, 1) ? 2 : -3), static_cast<double>(t[2])};
  for (Vec3& p : in.p) {
    p = in.light.center + rim + static_cast<double>(random.integer(-5, 5)) * along +
        static_cast<double>(random.integer(-4, 4)) * across;
  }
  return in;
}

/// One input of a mixture; the k-th of a run. Coordinates are finite always.
inline PredicateInput predicate_input(RandomInputs& random, int k) {
  PredicateInput in;
  switch (k % 4) {
    case 0:
      in.light = {random.uniform_point(), random.uniform_point(), random.uniform(0, 1)};
      for (Vec3& p : in.p) p = random.uniform_point(3.0);
      break;
    case 1:  // a small lattice: every degeneracy there is, equal points too
      in.light = {random.lattice_point(1), random.lattice_point(1),
                  static_cast<double>(random.integer(0, 3))};
      for (Vec3& p : in.p) p = random.lattice_point(2);
      break;
    default:
      in = tangent_input(random);
  }
  if (in.light.normal == Vec3(0.0)) in.light.normal = Vec3(0, 0, 1);
  if (k % 4 == 3) {
    random.nudge(in.p[random.integer(0, 3)]);
    if (random.integer(0, 1)) random.nudge(in.light.center);
  }
  // A third of all at some other scale, half of those by a power of two (degeneracy kept), half by any
  // factor.
  if (k % 3 == 0) {
    const double scale = random.integer(0, 1) ? std::ldexp(1.0, random.integer(-490, 490))
                                              : std::pow(10.0, random.uniform(-150, 150));
    for (Vec3& p : in.p) p *= scale;
    in.light.center *= scale;
    in.light.radius *= scale;
    if (random.integer(0, 1)) in.light.normal *= std::ldexp(1.0, random.integer(-490, 490));
  }
  return in;
}

// ---- the same for distant lights

inline CircularLight distant_light(const Vec3& direction, double radius) {
  CircularLight light = DistantLight{direction, 0.0};
  light.radius = radius;
  return light;
}

/// Points of a plane that touches the disk exactly: all coordinates are integers. With a Pythagorean triple t
/// and a radius p/q, (p t0, p t1, -q t2) leads to the rim of a light that shines along z, and (-t1, t0, 0)
/// along it. Both are turned by a matrix of integers whose columns are perpendicular and of one length, 1 or
/// 3. `line`: the line of the first two points, which are different, leads to the rim.
inline PredicateInput distant_tangent_input(RandomInputs& random, bool line = false) {
  static constexpr int kTriples[4][3] = {{3, 4, 5}, {5, 12, 13}, {8, 15, 17}, {20, 21, 29}};
  static constexpr int kRadii[6][2] = {{1, 2}, {3, 4}, {1, 1}, {5, 4}, {3, 1}, {1, 256}};
  static const Vec3 kColumns[2][3] = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{1, 2, 2}, {2, 1, -2}, {2, -2, 1}}};
  const auto& t = kTriples[random.integer(0, 3)];
  const auto& radius = kRadii[random.integer(0, 5)];
  const auto& columns = kColumns[random.integer(0, 1)];
  const int first = random.integer(0, 2);
  const auto turned = [&](double x, double y, double z) {
    return x * columns[first] + y * columns[(first + 1) % 3] + z * columns[(first + 2) % 3];
  };
  const int sx = random.integer(0, 1) ? 1 : -1, sy = random.integer(0, 1) ? 1 : -1;
  const int down = random.integer(0, 1) ? 1 : -1;
  const Vec3 rim = turned(radius[0] * sx * t[0], radius[0] * sy * t[1], -down * radius[1] * t[2]),
             along = turned(-sy * t[1], sx * t[0], 0);
  const Vec3 origin = std::ldexp(1.0, random.integer(0, 20)) * random.lattice_point(9);
  PredicateInput in;
  in.light = distant_light(turned(0, 0, down * random.integer(1, 3)),
                           static_cast<double>(radius[0]) / static_cast<double>(radius[1]));
  for (Vec3& p : in.p)
    p = origin + static_cast<double>(random.integer(-5, 5)) * along +
        static_cast<double>(random.integer(-4, 4)) * rim;
  if (line) in.p[1] = in.p[0] + static_cast<double>(2 * random.integer(-4, 3) + 1) * rim;
  return in;
}

/// One input of a mixture; the k-th of a run.
inline PredicateInput distant_input(RandomInputs& random, int k) {
  PredicateInput in;
  Vec3 direction(0.0);
  switch (k % 4) {
    case 0: {
      const double radius =
          random.integer(0, 1) ? random.uniform(0, 2) : std::pow(10.0, random.uniform(-9, 3));
      in.light = distant_light(random.uniform_point(), radius);
      for (Vec3& p : in.p) p = random.uniform_point(3.0);
      break;
    }
    case 1:  // a small lattice: every degeneracy there is, equal points too
      in.light = distant_light(random.lattice_point(1), static_cast<double>(random.integer(0, 3)));
      for (Vec3& p : in.p) p = random.lattice_point(2);
      break;
    default:
      in = distant_tangent_input(random);
  }
  direction = in.light.normal == Vec3(0.0) ? Vec3(0, 0, 1) : in.light.normal;
  double radius = in.light.radius;
  if (k % 4 == 3) {
    const int what = random.integer(0, 3);
    if (what <= 1) random.nudge(in.p[random.integer(0, 3)]);
    if (what == 1 || what == 2) random.nudge(direction);
    if (what == 3) radius = std::nextafter(radius, random.integer(0, 1) ? 0.0 : 1e9);
  }
  if (k % 3 == 0) {
    const double scale = random.integer(0, 1) ? std::ldexp(1.0, random.integer(-490, 490))
                                              : std::pow(10.0, random.uniform(-150, 150));
    for (Vec3& p : in.p) p *= scale;
    if (random.integer(0, 1)) direction *= std::ldexp(1.0, random.integer(-490, 490));
  }
  in.light = distant_light(direction, radius);
  return in;
}

}  // namespace penumbra::testing
