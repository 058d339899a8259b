#include "volumes/solids/shafts/caster_tree.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numeric>

#include "penumbra/volumes/predicates/predicates.h"

namespace penumbra::detail {
namespace {

constexpr std::size_t kLeaf = 4;
constexpr std::size_t kDeepest = 128;

/// The segment from p to p + way, by slabs.
bool meets(const Bounds& box, const Vec3& p, const Vec3& inverse) {
  const Vec3 a = (box.low - p) * inverse, b = (box.high - p) * inverse;
  const Vec3 low = glm::min(a, b), high = glm::max(a, b);
  const double enter = std::max({low.x, low.y, low.z}), leave = std::min({high.x, high.y, high.z});
  return !(enter > leave + 1e-9) && leave >= -1e-9 && enter <= 1.0 + 1e-9;
}

/// A little wider than the box, for what the slabs round.
Bounds widened(Bounds box) {
  const double by = 1e-12 * (glm::length(box.low) + glm::length(box.high));
  box.low -= Vec3(by);
  box.high += Vec3(by);
  return box;
}

}  // namespace

CasterTree::CasterTree(std::span<const TriangleMesh> casters, const CircularLight& light) {
  for (const TriangleMesh& mesh : casters) {
    const auto positions = mesh.positions();
    const auto triangles = mesh.triangles();
    std::vector<std::uint32_t> number(triangles.size(), kNoFace);
    std::vector<Face> all(triangles.size());
    tbb::parallel_for(std::size_t{0}, triangles.size(), [&](std::size_t f) {
      Face& face = all[f];
      int in_front = 0;
      for (int k = 0; k < 3; ++k) {
        face.corners[k] = positions[triangles[f][k]];
        face.vertices[k] = static_cast<std::uint32_t>(vertices_) + triangles[f][k];
        in_front += side_of_light_plane(face.corners[k], light) == Sign::kPositive ? 1 : 0;
      }
      face.in_front = in_front == 3;
      face.kind = classify_face(face.corners[0], face.corners[1], face.corners[2], light);
      number[f] = in_front > 0 ? 0 : kNoFace;
    });
    const auto first = static_cast<std::uint32_t>(faces_.size());
    std::uint32_t next = first;
    for (std::uint32_t& n : number)
      if (n != kNoFace) n = next++;
    for (std::size_t f = 0; f < all.size(); ++f) {
      if (number[f] == kNoFace) continue;
      for (int k = 0; k < 3; ++k) {
        const Edge& edge = mesh.edges()[index(mesh.face_edges()[f][k])];
        const FaceId other = index(edge.left) == f ? edge.right : edge.left;
        all[f].neighbors[k] = other == kNone<FaceId> ? kNoFace : number[index(other)];
      }
      for (const Vec3& p : all[f].corners) bounds_.add(p);
      faces_.push_back(all[f]);
    }
    for (const Component& component : mesh.components()) {
      for (const FaceId f : component.faces)
        if (number[index(f)] != kNoFace)
          faces_[number[index(f)]].component = static_cast<std::uint32_t>(components_);
      ++components_;
    }
    vertices_ += positions.size();
  }
  std::vector<Vec3> middles(faces_.size());
  for (std::size_t f = 0; f < faces_.size(); ++f)
    middles[f] = (faces_[f].corners[0] + faces_[f].corners[1] + faces_[f].corners[2]) / 3.0;
  order_.resize(faces_.size());
  std::iota(order_.begin(), order_.end(), 0u);
  if (!faces_.empty()) build(order_, 0, middles);
}

void CasterTree::build(std::span<std::uint32_t> order, std::size_t first, std::span<const Vec3> middles) {
  Bounds box, centers;
  for (const std::uint32_t f : order) {
    for (const Vec3& p : faces_[f].corners) box.add(p);
    centers.add(middles[f]);
  }
  const std::size_t at = nodes_.size();
  nodes_.push_back({.bounds = widened(box)});
  if (order.size() <= kLeaf) {
    nodes_[at].first = static_cast<std::uint32_t>(first);
    nodes_[at].count = static_cast<std::uint32_t>(order.size());
    return;
  }
  const Vec3 size = centers.high - centers.low;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
  const std::size_t middle = order.size() / 2;
  std::nth_element(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(middle), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) {
                     return std::pair(middles[a][axis], a) < std::pair(middles[b][axis], b);
                   });
  build(order.first(middle), first, middles);
  nodes_[at].first = static_cast<std::uint32_t>(nodes_.size());
  build(order.subspan(middle), first + middle, middles);
}

bool CasterTree::is_clear(const LightShaft& shaft, std::uint32_t& likely) const {
  const auto misses = [&](std::uint32_t f) {
    const auto& c = faces_[f].corners;
    return shaft.misses(c[0], c[1], c[2]);
  };
  if (faces_.empty()) return true;
  if (likely != kNoFace && !misses(likely)) return false;
  std::array<std::uint32_t, kDeepest> stack;
  std::size_t depth = 0;
  stack[depth++] = 0;
  while (depth > 0) {
    const std::uint32_t at = stack[--depth];
    const Node& node = nodes_[at];
    if (shaft.misses_box(node.bounds.low, node.bounds.high)) continue;
    if (node.count == 0) {
      stack[depth++] = node.first;
      stack[depth++] = at + 1;
      continue;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
      if (!misses(order_[i])) {
        likely = order_[i];
        return false;
      }
  }
  return true;
}

void CasterTree::crossings(const Vec3& from, const Vec3& to, std::vector<Crossing>& found,
                           bool& clean) const {
  found.clear();
  clean = true;
  if (faces_.empty()) return;
  const Vec3 way = to - from;
  const Vec3 inverse(1.0 / way.x, 1.0 / way.y, 1.0 / way.z);
  std::array<std::uint32_t, kDeepest> stack;
  std::size_t depth = 0;
  stack[depth++] = 0;
  while (depth > 0) {
    const std::uint32_t at = stack[--depth];
    const Node& node = nodes_[at];
    if (!meets(node.bounds, from, inverse)) continue;
    if (node.count == 0) {
      stack[depth++] = node.first;
      stack[depth++] = at + 1;
      continue;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      const auto& [a, b, c] = faces_[order_[i]].corners;
      const Sign before = orient3d(a, b, c, from), after = orient3d(a, b, c, to);
      if (before == after && before != Sign::kZero) continue;
      const std::array<Sign, 3> sides{orient3d(from, to, a, b), orient3d(from, to, b, c),
                                      orient3d(from, to, c, a)};
      const bool positive = std::ranges::count(sides, Sign::kPositive) > 0,
                 negative = std::ranges::count(sides, Sign::kNegative) > 0;
      if (positive && negative) continue;
      const bool touches =
          std::ranges::count(sides, Sign::kZero) > 0 || before == Sign::kZero || after == Sign::kZero;
      if (touches) {
        clean = false;
        continue;
      }
      const Vec3 normal = glm::cross(b - a, c - a);
      const double start = glm::dot(normal, from - a), along = glm::dot(normal, way);
      found.push_back({order_[i], along > 0.0 ? 1 : -1, -start / along});
    }
  }
  std::sort(found.begin(), found.end(), [](const Crossing& a, const Crossing& b) {
    return std::pair(a.distance, a.face) < std::pair(b.distance, b.face);
  });
}

}  // namespace penumbra::detail
