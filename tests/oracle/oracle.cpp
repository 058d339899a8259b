#include "tests/oracle/oracle.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "tests/oracle/signs.h"

namespace penumbra::oracle {
namespace {

constexpr double kUnit = 0x1p-53;
constexpr std::size_t kLeafTriangles = 4;

// splitmix64 (Steele, Lea, Flood 2014): one seed, one number in [0, 1).
double unit_number(std::uint64_t seed) {
  std::uint64_t z = seed + 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

struct Plane {
  Vec3 u, v;
};
Plane directions_across(const Vec3& normal) {
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
  return {u, glm::cross(m, u)};
}

bool blocks(const Ray& ray, const Corners& face) {
  const int first = side_of_edge(ray, face.a, face.b);
  const int second = side_of_edge(ray, face.b, face.c);
  if (first * second < 0) return false;
  const int third = side_of_edge(ray, face.c, face.a);
  if (first * third < 0 || second * third < 0) return false;
  // The sum of the three determinants is (q - x)·N, so their common sign is its sign. Where all are 0, the line lies in
  // the plane.
  const int across = first != 0 ? first : second != 0 ? second : third;
  return across != 0 && across == side_of_face(ray.x, face) && is_before_light(ray, face);
}

bool is_own(std::span<const CasterFace> own, const CasterFace& face) {
  return std::ranges::find(own, face) != own.end();
}

// Upper bound of the parameter at which the ray meets the light's plane; it is 1 but for the rounding of q.
double longest(const Ray& ray) {
  Bounded toward, until;
  for (int i = 0; i < 3; ++i) {
    const Bounded m{ray.normal[i], 0.0};
    toward = toward + m * difference(ray.x[i], ray.q[i]);
    until = until + m * difference(ray.x[i], ray.center[i]);
  }
  const double least = toward.value - toward.error;
  return least > 0.0 ? (until.value + until.error) / least * (1 + 8 * kUnit)
                     : std::numeric_limits<double>::infinity();
}

// Slab test (Kay, Kajiya 1986) that never misses a box that the ray meets. A parameter is a quotient of two differences:
// three roundings. Both ends of an interval are moved outward by 4u of their size, and by what underflow can cost.
bool meets(const Ray& ray, const Vec3& direction, double end, const Bounds& box) {
  double near = 0.0, far = end;
  for (int i = 0; i < 3; ++i) {
    if (direction[i] == 0.0) {
      if (ray.x[i] < box.low[i] || ray.x[i] > box.high[i]) return false;
      continue;
    }
    double enter = (box.low[i] - ray.x[i]) / direction[i], leave = (box.high[i] - ray.x[i]) / direction[i];
    if (enter > leave) std::swap(enter, leave);
    near = std::max(near, enter - (4 * kUnit * std::abs(enter) + 0x1p-1000));
    far = std::min(far, leave + (4 * kUnit * std::abs(leave) + 0x1p-1000));
  }
  return near <= far;
}

}  // namespace

std::vector<Vec3> light_samples(const DiskLight& light, int samples, std::uint64_t seed) {
  assert(samples >= 1);
  const Plane across = directions_across(light.normal);
  const double turn = std::numbers::pi * (3.0 - std::sqrt(5.0));
  const double start = 2.0 * std::numbers::pi * unit_number(seed);
  std::vector<Vec3> out;
  out.reserve(static_cast<std::size_t>(samples));
  for (int k = 0; k < samples; ++k) {
    const double radius = light.radius * std::sqrt((k + 0.5) / samples), angle = k * turn + start;
    out.push_back(light.center + (radius * std::cos(angle)) * across.u +
                  (radius * std::sin(angle)) * across.v);
  }
  return out;
}

Oracle::Oracle(std::span<const TriangleMesh> casters) {
  for (std::size_t object = 0; object < casters.size(); ++object) {
    const TriangleMesh& mesh = casters[object];
    for (std::size_t f = 0; f < mesh.triangles().size(); ++f) {
      const IndexedTriangle& t = mesh.triangles()[f];
      triangles_.push_back({mesh.positions()[t[0]],
                            mesh.positions()[t[1]],
                            mesh.positions()[t[2]],
                            {static_cast<std::uint32_t>(object), static_cast<FaceId>(f)}});
    }
  }
  if (!triangles_.empty()) build(0, triangles_.size());
}

void Oracle::build(std::size_t begin, std::size_t end) {
  const std::size_t node = nodes_.size();
  nodes_.push_back({{}, static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end - begin)});
  for (std::size_t t = begin; t < end; ++t)
    for (const Vec3& p : {triangles_[t].a, triangles_[t].b, triangles_[t].c}) nodes_[node].bounds.add(p);
  if (end - begin <= kLeafTriangles) return;

  const Vec3 size = nodes_[node].bounds.high - nodes_[node].bounds.low;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const std::size_t middle = begin + (end - begin) / 2;
  const auto center = [axis](const Triangle& t) { return t.a[axis] / 3 + t.b[axis] / 3 + t.c[axis] / 3; };
  const auto at = [this](std::size_t i) { return triangles_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(begin), at(middle), at(end),
                   [&](const Triangle& s, const Triangle& t) { return center(s) < center(t); });
  build(begin, middle);
  nodes_[node].first = static_cast<std::uint32_t>(nodes_.size());
  nodes_[node].count = 0;
  build(middle, end);
}

bool Oracle::blocked(const Vec3& x, const Vec3& q, std::span<const CasterFace> own,
                     const DiskLight& light) const {
  if (nodes_.empty()) return false;
  const Ray ray{x, q, light.center, light.normal};
  const Vec3 direction = q - x;
  const double end = longest(ray);
  std::uint32_t stack[64], size = 0;  // the depth is log2 F
  stack[size++] = 0;
  while (size > 0) {
    const std::uint32_t at = stack[--size];
    const Node& node = nodes_[at];
    if (!meets(ray, direction, end, node.bounds)) continue;
    if (node.count == 0) {
      stack[size++] = node.first;
      stack[size++] = at + 1;
    }
    for (std::uint32_t t = node.first; t < node.first + node.count; ++t)
      if (!is_own(own, triangles_[t].id) && blocks(ray, {triangles_[t].a, triangles_[t].b, triangles_[t].c}))
        return true;
  }
  return false;
}

bool Oracle::blocked_by_any(const Vec3& x, const Vec3& q, std::span<const CasterFace> own,
                            const DiskLight& light) const {
  const Ray ray{x, q, light.center, light.normal};
  return std::ranges::any_of(triangles_, [&](const Triangle& t) {
    return !is_own(own, t.id) && blocks(ray, {t.a, t.b, t.c});
  });
}

template <class Accept>
double Oracle::share(const Vec3& x, std::span<const CasterFace> own, const DiskLight& light, int samples,
                     std::uint64_t seed, const Accept& accept) const {
  if (sign_of_dot(light.normal, x, light.center) <= 0) return 0.0;
  int seen = 0;
  for (const Vec3& q : light_samples(light, samples, seed))
    if (accept(q) && !blocked(x, q, own, light)) ++seen;
  return static_cast<double>(seen) / samples;
}

double Oracle::unoccluded(const Vec3& x, std::span<const CasterFace> own, const DiskLight& light, int samples,
                          std::uint64_t seed) const {
  return share(x, own, light, samples, seed, [](const Vec3&) { return true; });
}

double Oracle::visibility(const Vec3& x, const Vec3& normal, std::optional<CasterFace> own,
                          const DiskLight& light, int samples, std::uint64_t seed) const {
  const std::span<const CasterFace> faces = own ? std::span(&*own, 1) : std::span<const CasterFace>();
  return share(x, faces, light, samples, seed, [&](const Vec3& q) { return sign_of_dot(normal, q, x) > 0; });
}

}  // namespace penumbra::oracle
