#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "tests/oracle/oracle.h"

namespace penumbra::oracle {
namespace {

// splitmix64 (Steele, Lea, Flood 2014): one seed, one number in [0, 1).
double unit_number(std::uint64_t seed) {
  std::uint64_t z = seed + 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

/// Orthonormal; m along the normal.
struct Frame {
  Vec3 m, u, v;
};
Frame frame_along(const Vec3& normal) {
  const double scale = std::max({std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)});
  assert(scale > 0.0);
  const Vec3 m = glm::normalize(Vec3(normal.x / scale, normal.y / scale, normal.z / scale));
  // The axis of the least |m_i| is at least 54 degrees off m.
  int least = 0;
  for (int i = 1; i < 3; ++i)
    if (std::abs(m[i]) < std::abs(m[least])) least = i;
  Vec3 axis(0.0);
  axis[least] = 1.0;
  const Vec3 u = glm::normalize(glm::cross(m, axis));
  return {m, u, glm::cross(m, u)};
}

std::vector<Vec3> disk_samples(const Vec3& center, const Frame& frame, double radius, int samples,
                               std::uint64_t seed) {
  const double turn = std::numbers::pi * (3.0 - std::sqrt(5.0));
  const double start = 2.0 * std::numbers::pi * unit_number(seed);
  std::vector<Vec3> out;
  out.reserve(static_cast<std::size_t>(samples));
  for (int k = 0; k < samples; ++k) {
    const double at = radius * std::sqrt((k + 0.5) / samples), angle = k * turn + start;
    out.push_back(center + (at * std::cos(angle)) * frame.u + (at * std::sin(angle)) * frame.v);
  }
  return out;
}

std::vector<Vec3> samples_of(const DiskLight& light, int samples, std::uint64_t seed) {
  return disk_samples(light.center, frame_along(light.normal), light.radius, samples, seed);
}

// At distance 1, where the radius is the tangent of half the angle.
std::vector<Vec3> samples_of(const DistantLight& light, int samples, std::uint64_t seed) {
  const Frame frame = frame_along(light.direction);
  const double half_angle = light.angle_degrees * std::numbers::pi / 360.0;
  return disk_samples(-frame.m, frame, std::tan(half_angle), samples, seed);
}

std::vector<Vec3> samples_of(const Rectangle& light, int samples, std::uint64_t seed) {
  constexpr double kStep = 0.7548776662466927;  // a³ + a² = 1
  const double first = unit_number(seed), second = unit_number(~seed);
  const auto fraction = [](double a) { return a - std::floor(a); };
  std::vector<Vec3> out;
  out.reserve(static_cast<std::size_t>(samples));
  for (int k = 0; k < samples; ++k) {
    const double s = 2.0 * fraction(first + k * kStep) - 1.0,
                 t = 2.0 * fraction(second + k * kStep * kStep) - 1.0;
    out.push_back(light.center + s * light.u + t * light.v);
  }
  return out;
}

}  // namespace

std::vector<Vec3> light_samples(const Light& light, int samples, std::uint64_t seed) {
  assert(samples >= 1);
  return std::visit([&](const auto& shape) { return samples_of(shape, samples, seed); }, light);
}

}  // namespace penumbra::oracle
