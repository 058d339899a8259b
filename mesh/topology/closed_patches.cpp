#include "mesh/topology/closed_patches.h"

#include <algorithm>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <set>
#include <tuple>

#include "mesh/topology/disjoint_sets.h"

namespace penumbra::detail {
namespace {

/// How many half-edges run along an edge from its lower vertex to the higher one, and back.
struct Count {
  int forth = 0, back = 0;
  int net() const { return forth - back; }
};

class Patches {
 public:
  Patches(std::span<const Vec3> positions, std::span<const IndexedTriangle> triangles,
          const EdgeGroups& groups, std::span<const std::uint32_t> crowded,
          const std::vector<std::uint32_t>& opposite);
  std::vector<bool> run();

 private:
  struct Share {
    std::uint32_t edge;  ///< number in crowded_
    Count own;
  };
  struct Candidate {
    double area;
    std::vector<IndexedTriangle> faces;
    std::uint32_t patch;
    /// By area, then by the faces themselves, so that their order in the file plays no part. Of faces that
    /// repeat each other the last comes first.
    bool operator<(const Candidate& other) const {
      return std::tie(area, faces, other.patch) < std::tie(other.area, other.faces, patch);
    }
  };

  std::uint32_t patch_of(std::uint32_t half_edge) const { return patch_[half_edge / 3]; }
  void put_aside(std::uint32_t patch);
  void look_at(std::uint32_t edge);
  void settle();
  bool is_spare(std::uint32_t patch) const;
  void put_spare_aside();
  std::vector<std::uint32_t> patches_by_area() const;

  std::span<const Vec3> positions_;
  std::span<const IndexedTriangle> triangles_;
  const EdgeGroups& groups_;
  std::span<const std::uint32_t> crowded_;
  std::vector<std::uint32_t> patch_;        ///< of each face: its lowest face
  std::vector<std::vector<Share>> shares_;  ///< of each patch
  std::vector<Count> left_;                 ///< at each crowded edge: of faces that are not put aside
  std::vector<bool> aside_;                 ///< by patch; by face in the end
  std::vector<std::uint32_t> aside_list_;
  std::size_t settled_ = 0;  ///< so many of aside_list_ have been followed up
};

Patches::Patches(std::span<const Vec3> positions, std::span<const IndexedTriangle> triangles,
                 const EdgeGroups& groups, std::span<const std::uint32_t> crowded,
                 const std::vector<std::uint32_t>& opposite)
    : positions_(positions),
      triangles_(triangles),
      groups_(groups),
      crowded_(crowded),
      shares_(triangles.size()),
      left_(crowded.size()),
      aside_(triangles.size(), false) {
  DisjointSets sets(triangles.size());
  for (std::uint32_t h = 0; h < opposite.size(); ++h)
    if (opposite[h] != kNoHalfEdge) sets.join(h / 3, opposite[h] / 3);
  patch_ = std::move(sets).all();
  for (std::uint32_t edge = 0; edge < crowded.size(); ++edge)
    for (const std::uint32_t h : groups[crowded[edge]]) {
      std::vector<Share>& shares = shares_[patch_of(h)];
      if (shares.empty() || shares.back().edge != edge) shares.push_back({edge, {}});
      const bool forth = vertex_at(triangles, h) < vertex_at(triangles, next_in_face(h));
      ++(forth ? shares.back().own.forth : shares.back().own.back);
      ++(forth ? left_[edge].forth : left_[edge].back);
    }
}

std::vector<bool> Patches::run() {
  for (std::size_t g = 0; g < groups_.size(); ++g)
    if (groups_[g].size() == 1) put_aside(patch_of(groups_[g][0]));
  for (std::uint32_t edge = 0; edge < crowded_.size(); ++edge) look_at(edge);
  settle();
  put_spare_aside();
  for (std::uint32_t f = 0; f < aside_.size(); ++f) aside_[f] = aside_[patch_[f]];
  return std::move(aside_);
}

void Patches::put_aside(std::uint32_t patch) {
  if (aside_[patch]) return;
  aside_[patch] = true;
  aside_list_.push_back(patch);
  for (const Share& share : shares_[patch]) {
    left_[share.edge].forth -= share.own.forth;
    left_[share.edge].back -= share.own.back;
  }
}

/// Rules 1 and 2 at one edge.
void Patches::look_at(std::uint32_t edge) {
  if ((left_[edge].forth == 0) == (left_[edge].back == 0)) return;
  for (const std::uint32_t h : groups_[crowded_[edge]]) put_aside(patch_of(h));
}

void Patches::settle() {
  for (; settled_ < aside_list_.size(); ++settled_)
    for (const Share& share : shares_[aside_list_[settled_]]) look_at(share.edge);
}

/// Rule 3.
bool Patches::is_spare(std::uint32_t patch) const {
  bool any = false;
  for (const Share& share : shares_[patch]) {
    const int own = share.own.net(), all = left_[share.edge].net();
    if (own == 0) continue;
    if ((own > 0) != (all > 0) || std::abs(own) > std::abs(all)) return false;
    any = true;
  }
  return any;
}

void Patches::put_spare_aside() {
  if (std::ranges::all_of(left_, [](const Count& count) { return count.net() == 0; })) return;
  const std::vector<std::uint32_t> order = patches_by_area();
  std::vector<std::uint32_t> rank(shares_.size());
  std::set<std::uint32_t> to_ask;
  for (std::uint32_t i = 0; i < order.size(); ++i) {
    rank[order[i]] = i;
    to_ask.insert(to_ask.end(), i);
  }
  while (!to_ask.empty()) {
    const std::uint32_t patch = order[*to_ask.begin()];
    to_ask.erase(to_ask.begin());
    if (aside_[patch] || !is_spare(patch)) continue;
    const std::size_t before = aside_list_.size();
    put_aside(patch);
    settle();
    for (std::size_t i = before; i < aside_list_.size(); ++i)
      for (const Share& share : shares_[aside_list_[i]])
        for (const std::uint32_t h : groups_[crowded_[share.edge]])
          if (!aside_[patch_of(h)]) to_ask.insert(rank[patch_of(h)]);
  }
}

/// Those that are not put aside and have crowded edges.
std::vector<std::uint32_t> Patches::patches_by_area() const {
  std::vector<std::vector<IndexedTriangle>> faces(shares_.size());
  for (std::uint32_t f = 0; f < triangles_.size(); ++f) {
    if (aside_[patch_[f]] || shares_[patch_[f]].empty()) continue;
    IndexedTriangle t = triangles_[f];
    std::rotate(t.begin(), std::ranges::min_element(t), t.end());
    faces[patch_[f]].push_back(t);
  }
  std::vector<Candidate> candidates;
  for (std::uint32_t patch = 0; patch < faces.size(); ++patch) {
    if (faces[patch].empty()) continue;
    std::ranges::sort(faces[patch]);
    double area = 0.0;
    for (const auto& [a, b, c] : faces[patch])
      area += glm::length(glm::cross(positions_[b] - positions_[a], positions_[c] - positions_[a]));
    candidates.push_back({area, std::move(faces[patch]), patch});
  }
  std::sort(candidates.begin(), candidates.end());
  std::vector<std::uint32_t> order;
  for (const Candidate& candidate : candidates) order.push_back(candidate.patch);
  return order;
}

}  // namespace

std::vector<bool> put_open_patches_aside(std::span<const Vec3> positions,
                                         std::span<const IndexedTriangle> triangles, const EdgeGroups& groups,
                                         std::span<const std::uint32_t> crowded,
                                         const std::vector<std::uint32_t>& opposite) {
  return Patches(positions, triangles, groups, crowded, opposite).run();
}

}  // namespace penumbra::detail
