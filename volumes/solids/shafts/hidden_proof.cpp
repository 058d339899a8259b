#include "volumes/solids/shafts/hidden_proof.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "mesh/vectors.h"

namespace penumbra::detail {
namespace {

/// Speed: larger patches are given up.
constexpr std::size_t kMostFaces = 2000;
/// Speed: so many crossings of a segment are tried.
constexpr std::size_t kMostCrossings = 4;

}  // namespace

HiddenProof::HiddenProof(const CasterTree& tree, const CircularLight& light)
    : tree_(tree),
      light_(light),
      frame_(light_frame(light)),
      seen_(tree.faces().size(), 0),
      beyond_(tree.vertex_count(), 0),
      beyond_of_(tree.vertex_count(), 0) {}

std::uint32_t HiddenProof::sides_beyond(const LightShaft& shaft, const CasterTree::Face& face, int corner) {
  const std::uint32_t v = face.vertices[corner];
  if (beyond_of_[v] != shaft_) {
    beyond_of_[v] = shaft_;
    beyond_[v] = shaft.sides_beyond(face.corners[corner]);
  }
  return beyond_[v];
}

/// Whether a patch from the face on keeps T from D.
bool HiddenProof::separates(const LightShaft& shaft, std::uint32_t first) {
  const auto faces = tree_.faces();
  if (seen_[first] >= first_patch_) return false;  // part of a patch that does not
  ++patch_;
  waiting_.assign(1, first);
  seen_[first] = patch_;
  std::size_t visited = 0;
  while (!waiting_.empty()) {
    const CasterTree::Face& face = faces[waiting_.back()];
    waiting_.pop_back();
    if (++visited > kMostFaces || !face.in_front) return false;
    const auto& c = face.corners;
    if (!shaft.base_misses(c[0], c[1], c[2])) return false;
    const std::array<std::uint32_t, 3> beyond{sides_beyond(shaft, face, 0), sides_beyond(shaft, face, 1),
                                              sides_beyond(shaft, face, 2)};
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t next = face.neighbors[k];
      if (next != CasterTree::kNoFace && seen_[next] == patch_) continue;
      const Vec3 &a = c[k], &b = c[(k + 1) % 3];
      if ((beyond[k] & beyond[(k + 1) % 3]) != 0) continue;
      const bool is_open = next == CasterTree::kNoFace;
      if ((is_open || faces[next].kind != face.kind) && shaft.misses(a, b, b)) continue;
      if (is_open) return false;
      seen_[next] = patch_;
      waiting_.push_back(next);
    }
  }
  int sum = 0;
  for (const Crossing& c : crossings_)
    if (seen_[c.face] == patch_) sum += c.sign;
  return sum != 0;
}

bool HiddenProof::holds_undivided(std::span<const Vec3> points) {
  Vec3 middle(0.0);
  for (const Vec3& p : points) middle += p / static_cast<double>(points.size());
  Bounds all = tree_.bounds();
  for (const Vec3& p : points) all.add(p);
  const double extent = 2.0 * all.radius();
  const Vec3 end = light_.is_distant() ? middle - 2.0 * extent * unit(light_.normal) : light_.center;
  bool clean = true;
  tree_.crossings(middle, end, crossings_, clean);
  if (!clean || crossings_.empty()) return false;
  const LightShaft shaft(light_, frame_, points, extent);
  ++shaft_;
  first_patch_ = patch_ + 1;
  std::size_t tries = 0;
  for (auto c = crossings_.rbegin(); c != crossings_.rend() && tries < kMostCrossings; ++c, ++tries)
    if (separates(shaft, c->face)) return true;
  return false;
}

bool HiddenProof::holds(std::span<const Vec3> points, int depth) {
  if (holds_undivided(points)) return true;
  if (depth <= 0 || points.size() != 3) return false;
  const Vec3 ab = 0.5 * (points[0] + points[1]), bc = 0.5 * (points[1] + points[2]),
             ca = 0.5 * (points[2] + points[0]);
  const std::array<std::array<Vec3, 3>, 4> parts{
      {{ab, bc, ca}, {points[0], ab, ca}, {ab, points[1], bc}, {ca, bc, points[2]}}};
  return std::all_of(parts.begin(), parts.end(), [&](const auto& part) { return holds(part, depth - 1); });
}

}  // namespace penumbra::detail
