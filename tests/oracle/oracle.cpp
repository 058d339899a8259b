#include "tests/oracle/oracle.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>

#include "tests/oracle/signs.h"

namespace penumbra::oracle {
namespace {

constexpr double kUnit = 0x1p-53;
constexpr std::size_t kLeafTriangles = 4;

bool blocks(const Ray& ray, const Corners& face) {
  const int first = side_of_edge(ray, face.a, face.b);
  const int second = side_of_edge(ray, face.b, face.c);
  if (first * second < 0) return false;
  const int third = side_of_edge(ray, face.c, face.a);
  if (first * third < 0 || second * third < 0) return false;
  // The sum of the three determinants is (q - x)·N, so their common sign is its sign. Where all are 0, the
  // line lies in the plane.
  const int across = first != 0 ? first : second != 0 ? second : third;
  return across != 0 && across == side_of_face(ray.x, face) && is_before_light(ray, face);
}

bool is_own(std::span<const CasterFace> own, const CasterFace& face) {
  return std::ranges::find(own, face) != own.end();
}

/// The plane at which rays end, if there is one.
struct Emitter {
  Vec3 center, normal;
  bool distant;
};
Emitter emitter_of(const Light& light) {
  if (std::holds_alternative<DistantLight>(light)) return {Vec3(0.0), Vec3(0.0), true};
  if (const auto* disk = std::get_if<DiskLight>(&light)) return {disk->center, disk->normal, false};
  const auto& rectangle = std::get<Rectangle>(light);
  return {rectangle.center, glm::cross(rectangle.u, rectangle.v), false};
}
Ray ray_to(const Vec3& x, const Vec3& q, const Emitter& emitter) {
  return {x, q, emitter.center, emitter.normal, emitter.distant};
}

// Upper bound of the parameter at which the ray meets the light's plane; it is 1 but for the rounding of q.
double longest(const Ray& ray) {
  if (ray.endless) return std::numeric_limits<double>::infinity();
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

// Slab test (Kay, Kajiya 1986) that never misses a box that the ray meets. A parameter is a quotient of two
// differences: three roundings, or two where the direction is exact. Both ends of an interval are moved
// outward by 4u of their size, and by what underflow can cost.
bool meets(const Vec3& start, const Vec3& direction, double end, const Bounds& box) {
  double near = 0.0, far = end;
  for (int i = 0; i < 3; ++i) {
    if (direction[i] == 0.0) {
      if (start[i] < box.low[i] || start[i] > box.high[i]) return false;
      continue;
    }
    double enter = (box.low[i] - start[i]) / direction[i], leave = (box.high[i] - start[i]) / direction[i];
    if (enter > leave) std::swap(enter, leave);
    near = std::max(near, enter - (4 * kUnit * std::abs(enter) + 0x1p-1000));
    far = std::min(far, leave + (4 * kUnit * std::abs(leave) + 0x1p-1000));
  }
  return near <= far;
}

}  // namespace

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

template <class Visit>
void Oracle::walk(const Vec3& start, const Vec3& direction, double& end, const Visit& visit) const {
  if (nodes_.empty()) return;
  std::uint32_t stack[64], size = 0;  // the depth is log2 F
  stack[size++] = 0;
  while (size > 0) {
    const std::uint32_t at = stack[--size];
    const Node& node = nodes_[at];
    if (!meets(start, direction, end, node.bounds)) continue;
    if (node.count == 0) {
      stack[size++] = node.first;
      stack[size++] = at + 1;
    }
    for (std::uint32_t t = node.first; t < node.first + node.count; ++t)
      if (!visit(triangles_[t])) return;
  }
}

bool Oracle::blocked(const Vec3& x, const Vec3& q, std::span<const CasterFace> own,
                     const Light& light) const {
  const Ray ray = ray_to(x, q, emitter_of(light));
  return blocker(ray, own, nullptr) != nullptr;
}

const Oracle::Triangle* Oracle::blocker(const Ray& ray, std::span<const CasterFace> own,
                                        const Triangle* likely) const {
  const auto is_blocker = [&](const Triangle& t) {
    return !is_own(own, t.id) && blocks(ray, {t.a, t.b, t.c});
  };
  if (likely && is_blocker(*likely)) return likely;
  double end = longest(ray);
  const Triangle* found = nullptr;
  walk(ray.x, ray.endless ? ray.q : ray.q - ray.x, end, [&](const Triangle& t) {
    if (is_blocker(t)) found = &t;
    return found == nullptr;
  });
  return found;
}

bool Oracle::blocked_by_any(const Vec3& x, const Vec3& q, std::span<const CasterFace> own,
                            const Light& light) const {
  const Ray ray = ray_to(x, q, emitter_of(light));
  return std::ranges::any_of(triangles_, [&](const Triangle& t) {
    return !is_own(own, t.id) && blocks(ray, {t.a, t.b, t.c});
  });
}

std::optional<Hit> Oracle::first_hit(const Vec3& start, const Vec3& direction) const {
  const Ray ray{start, direction, Vec3(0.0), Vec3(0.0), true};
  std::optional<Hit> first;
  double end = std::numeric_limits<double>::infinity();
  walk(start, direction, end, [&](const Triangle& t) {
    if (!blocks(ray, {t.a, t.b, t.c})) return true;
    const Vec3 normal = glm::cross(t.b - t.a, t.c - t.a);
    const double distance = glm::dot(t.a - start, normal) / glm::dot(direction, normal);
    if (!first || distance < first->distance) first = {t.id, distance};
    end = first->distance * (1 + 64 * kUnit);
    return true;
  });
  return first;
}

template <class Accept>
double Oracle::share(const Vec3& x, std::span<const CasterFace> own, const Light& light, int samples,
                     std::uint64_t seed, const Accept& accept) const {
  const Emitter emitter = emitter_of(light);
  if (!emitter.distant && sign_of_dot(emitter.normal, x, emitter.center) <= 0) return 0.0;
  int seen = 0;
  const Triangle* last = nullptr;
  for (const Vec3& q : light_samples(light, samples, seed)) {
    if (!accept(q)) continue;
    const Triangle* found = blocker(ray_to(x, q, emitter), own, last);
    if (found) last = found;
    seen += found == nullptr;
  }
  return static_cast<double>(seen) / samples;
}

double Oracle::unoccluded(const Vec3& x, std::span<const CasterFace> own, const Light& light, int samples,
                          std::uint64_t seed) const {
  return share(x, own, light, samples, seed, [](const Vec3&) { return true; });
}

double Oracle::visibility(const Vec3& x, const Vec3& normal, std::optional<CasterFace> own,
                          const Light& light, int samples, std::uint64_t seed) const {
  const std::span<const CasterFace> faces = own ? std::span(&*own, 1) : std::span<const CasterFace>();
  // The direction to q is q - x, or q itself.
  const Vec3 from = emitter_of(light).distant ? Vec3(0.0) : x;
  return share(x, faces, light, samples, seed,
               [&](const Vec3& q) { return sign_of_dot(normal, q, from) > 0; });
}

}  // namespace penumbra::oracle
