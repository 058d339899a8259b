#include "volumes/solids/shafts/group_patches.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "mesh/vectors.h"

namespace penumbra::detail {
namespace {

// Speed. Larger patches are given up, and those of which a set may meet so many faces or has to look at so
// many edges.
constexpr std::size_t kMostFaces = 4000, kMostNear = 64, kMostRim = 256;
/// Speed: so many patches are kept.
constexpr std::size_t kMostPatches = 3;

}  // namespace

GroupPatches::GroupPatches(const CasterTree& tree, const CircularLight& light, const LightFrame& frame)
    : tree_(tree),
      light_(light),
      frame_(frame),
      of_hull_(tree.vertex_count()),
      of_middle_(tree.vertex_count()),
      patch_of_(tree.faces().size(), 0),
      patches_(kMostPatches) {}

void GroupPatches::find(std::span<const Vec3> hull, double extent) {
  count_ = 0;
  Vec3 middle(0.0);
  for (const Vec3& p : hull) middle += p / static_cast<double>(hull.size());
  const Vec3 end = light_.is_distant() ? middle - 2.0 * extent * unit(light_.normal) : light_.center;
  bool clean = true;
  tree_.crossings(middle, end, crossings_, clean);
  if (crossings_.empty()) return;
  const LightShaft shaft(light_, frame_, hull, extent);
  const LightShaft of_middle(light_, frame_, std::span(&middle, 1), extent);
  of_hull_.begin(shaft);
  of_middle_.begin(of_middle);
  before_ = last_;
  for (auto c = crossings_.rbegin(); c != crossings_.rend() && count_ < kMostPatches; ++c) {
    if (patch_of_[c->face] > before_) continue;  // in a patch already
    if (grow(shaft, c->face, patches_[count_])) ++count_;
  }
}

/// Does not change the group's other patches.
bool GroupPatches::grow(const LightShaft& shaft, std::uint32_t first, Patch& patch) {
  const auto faces = tree_.faces();
  patch.number = ++last_;
  patch.rim.clear();
  patch.near.clear();
  waiting_.assign(1, first);
  patch_of_[first] = last_;
  std::size_t visited = 0;
  while (!waiting_.empty()) {
    const std::uint32_t here = waiting_.back();
    const CasterTree::Face& face = faces[here];
    waiting_.pop_back();
    if (++visited > kMostFaces || !face.in_front) return false;
    const auto& c = face.corners;
    if (!shaft.base_misses(c[0], c[1], c[2])) patch.near.push_back(here);
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t next = face.neighbors[k];
      if (next != CasterTree::kNoFace && patch_of_[next] == last_) continue;
      const Rim edge{face.vertices[k], face.vertices[(k + 1) % 3], c[k], c[(k + 1) % 3], next};
      if (of_hull_.are_outside(edge.a, edge.at_a, edge.b, edge.at_b)) continue;
      const bool is_open = next == CasterTree::kNoFace;
      if (is_open || patch_of_[next] > before_ ||
          (faces[next].kind != face.kind && (of_middle_.are_outside(edge.a, edge.at_a, edge.b, edge.at_b) ||
                                             of_middle_.misses(edge.a, edge.at_a, edge.b, edge.at_b)))) {
        patch.rim.push_back(edge);
        continue;
      }
      patch_of_[next] = last_;
      waiting_.push_back(next);
    }
    if (patch.near.size() > kMostNear || patch.rim.size() > kMostRim) return false;
  }
  std::erase_if(patch.rim, [&](const Rim& e) {
    return e.next != CasterTree::kNoFace && patch_of_[e.next] == patch.number;
  });
  return true;
}

}  // namespace penumbra::detail
