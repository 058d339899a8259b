#include "volumes/solids/shafts/hidden_proof.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "mesh/vectors.h"

namespace penumbra::detail {
namespace {

/// Speed: larger patches are given up.
constexpr std::size_t kMostFaces = 2000;
/// Speed: so many crossings of a segment are tried.
constexpr std::size_t kMostCrossings = 4;

/// Nothing that is asked about lies farther from the points.
double extent_of(const CasterTree& tree, std::span<const Vec3> points) {
  Bounds all = tree.bounds();
  for (const Vec3& p : points) all.add(p);
  return 2.0 * all.radius();
}

}  // namespace

HiddenProof::HiddenProof(const CasterTree& tree, const CircularLight& light)
    : tree_(tree),
      light_(light),
      frame_(light_frame(light)),
      group_(tree, light, frame_),
      places_(tree.vertex_count()),
      seen_(tree.faces().size(), 0) {}

void HiddenProof::begin_group(std::span<const Vec3> hull) {
  group_.clear();
  if (!hull.empty()) group_.find(hull, extent_of(tree_, hull));
}

void HiddenProof::begin_patch() {
  ++patch_;
  waiting_.clear();
  sum_ = 0;
  outside_ = crossings_.size();
}

void HiddenProof::add(std::uint32_t face) {
  seen_[face] = patch_;
  waiting_.push_back(face);
  for (const Crossing& c : crossings_) {
    if (c.face != face) continue;
    sum_ += c.sign;
    --outside_;
  }
}

/// Adds faces until the patch's boundary misses the shaft. `base`: faces that belong to the patch.
/// `opposite`: where one of these faces would join it, the patch is given up. False where T meets the patch,
/// its boundary cannot be found, or its number of crossings will be 0.
bool HiddenProof::grow(const LightShaft& shaft, const GroupPatches::Patch* base,
                       const GroupPatches::Patch* opposite) {
  const auto faces = tree_.faces();
  std::size_t visited = 0;
  while (!waiting_.empty()) {
    if (outside_ == 0 && sum_ == 0) return false;
    const std::uint32_t here = waiting_.back();
    const CasterTree::Face& face = faces[here];
    waiting_.pop_back();
    if (++visited > kMostFaces || !face.in_front || (opposite && group_.is_in(here, *opposite))) return false;
    const auto& c = face.corners;
    if (!shaft.base_misses(c[0], c[1], c[2])) return false;
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t next = face.neighbors[k], va = face.vertices[k], vb = face.vertices[(k + 1) % 3];
      const bool is_open = next == CasterTree::kNoFace;
      if (!is_open && (seen_[next] == patch_ || (base && group_.is_in(next, *base)))) continue;
      const Vec3 &a = c[k], &b = c[(k + 1) % 3];
      if (places_.are_outside(va, a, vb, b)) continue;
      if ((is_open || faces[next].kind != face.kind) && places_.misses(va, a, vb, b)) continue;
      if (is_open) return false;
      add(next);
    }
  }
  return sum_ != 0;
}

int HiddenProof::sum_in(const GroupPatches::Patch& patch) const {
  int sum = 0;
  for (const Crossing& c : crossings_)
    if (group_.is_in(c.face, patch)) sum += c.sign;
  return sum;
}

/// Whether a patch that begins with one of the group's keeps T from D. kUnknown: T has no number of crossings
/// of them but 0.
HiddenProof::Answer HiddenProof::by_group(const LightShaft& shaft, bool thorough) {
  const auto faces = tree_.faces();
  const auto may_meet = [&](std::uint32_t f) {
    const auto& c = faces[f].corners;
    return !shaft.base_misses(c[0], c[1], c[2]);
  };
  Answer answer = Answer::kUnknown;
  for (const GroupPatches::Patch& patch : group_.patches()) {
    const int sum = sum_in(patch);
    if (sum == 0) continue;
    answer = Answer::kOpen;
    if (std::ranges::any_of(patch.near, may_meet)) continue;
    begin_patch();
    sum_ = sum;
    outside_ -= static_cast<std::size_t>(
        std::ranges::count_if(crossings_, [&](const Crossing& c) { return group_.is_in(c.face, patch); }));
    const GroupPatches::Patch* opposite = nullptr;
    for (const GroupPatches::Patch& other : group_.patches())
      if (!thorough && sum_in(other) == -sum) opposite = &other;
    const auto is_closed = [&](const GroupPatches::Rim& e) {
      if (places_.are_outside(e.a, e.at_a, e.b, e.at_b) || places_.misses(e.a, e.at_a, e.b, e.at_b))
        return true;
      if (e.next == CasterTree::kNoFace || (opposite && group_.is_in(e.next, *opposite))) return false;
      if (seen_[e.next] != patch_) add(e.next);
      return true;
    };
    if (std::ranges::all_of(patch.rim, is_closed) && grow(shaft, &patch, opposite)) return Answer::kHidden;
  }
  return answer;
}

/// Whether a patch from the face on keeps T from D.
bool HiddenProof::by_patch_of(std::uint32_t first, const LightShaft& shaft) {
  if (seen_[first] >= first_patch_) return false;  // part of a patch that does not
  begin_patch();
  add(first);
  return grow(shaft, nullptr, nullptr);
}

bool HiddenProof::holds_undivided(std::span<const Vec3> points, bool thorough) {
  Vec3 middle(0.0);
  for (const Vec3& p : points) middle += p / static_cast<double>(points.size());
  const double extent = extent_of(tree_, points);
  const Vec3 end = light_.is_distant() ? middle - 2.0 * extent * unit(light_.normal) : light_.center;
  bool clean = true;
  tree_.crossings(middle, end, crossings_, clean);
  if (!clean || crossings_.empty()) return false;
  const LightShaft shaft(light_, frame_, points, extent);
  places_.begin(shaft);
  const Answer answer = by_group(shaft, thorough);
  if (answer == Answer::kHidden || (answer == Answer::kOpen && !thorough)) return answer == Answer::kHidden;
  first_patch_ = patch_ + 1;
  std::size_t tries = 0;
  for (auto c = crossings_.rbegin(); c != crossings_.rend() && tries < kMostCrossings; ++c, ++tries)
    if (by_patch_of(c->face, shaft)) return true;
  return false;
}

bool HiddenProof::holds(std::span<const Vec3> points, const Effort& effort) {
  if (holds_undivided(points, effort.thorough)) return true;
  if (effort.depth <= 0 || points.size() != 3) return false;
  const Vec3 ab = 0.5 * (points[0] + points[1]), bc = 0.5 * (points[1] + points[2]),
             ca = 0.5 * (points[2] + points[0]);
  const std::array<std::array<Vec3, 3>, 4> parts{
      {{ab, bc, ca}, {points[0], ab, ca}, {ab, points[1], bc}, {ca, bc, points[2]}}};
  return std::all_of(parts.begin(), parts.end(), [&](const auto& part) {
    return holds(part, {effort.depth - 1, effort.thorough});
  });
}

}  // namespace penumbra::detail
