#include "mesh/topology/face_pairs.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>
#include <tuple>
#include <utility>

#include "mesh/topology/closed_patches.h"
#include "mesh/vectors.h"

namespace penumbra::detail {
namespace {

/// One face about an edge, seen so that the edge runs from its lower vertex towards the eye.
struct Spoke {
  double angle, error;  ///< counter-clockwise, radians
  bool ends_solid;      ///< the solid lies clockwise of the face
  std::uint32_t apex, half_edge;
};

class Pairing {
 public:
  Pairing(std::span<const Vec3> positions, std::span<const IndexedTriangle> triangles,
          const EdgeGroups& groups, std::vector<std::uint32_t>& opposite)
      : positions_(positions), triangles_(triangles), groups_(groups), opposite_(opposite) {}

  void run(std::span<const std::uint32_t> crowded) {
    const std::vector<bool> aside =
        put_open_patches_aside(positions_, triangles_, groups_, crowded, opposite_);
    for (const std::uint32_t g : crowded)
      for (const bool which : {false, true}) {
        std::vector<std::uint32_t> faces;
        std::ranges::copy_if(groups_[g], std::back_inserter(faces),
                             [&](std::uint32_t h) { return aside[h / 3] == which; });
        if (const auto forth = std::ranges::count_if(faces, [&](std::uint32_t h) { return is_forth(h); });
            2 * forth == std::ssize(faces))
          pair_by_angle(faces);
      }
    std::vector<std::uint32_t> fans = find_fans(opposite_);
    for (const std::uint32_t g : crowded) part_fans(g, fans);
    do {
      fans = find_fans(opposite_);
    } while (cut_doubled_edges(crowded, fans));
  }

 private:
  std::uint32_t vertex(std::uint32_t corner) const { return vertex_at(triangles_, corner); }
  bool is_forth(std::uint32_t h) const { return vertex(h) < vertex(next_in_face(h)); }
  void join(std::uint32_t a, std::uint32_t b) {
    opposite_[a] = b;
    opposite_[b] = a;
  }
  std::vector<Spoke> spokes_of(const std::vector<std::uint32_t>& faces) const;
  void pair_by_angle(const std::vector<std::uint32_t>& faces);
  std::vector<std::uint32_t> pairs_of(std::uint32_t g) const;
  bool is_one_fan(std::uint32_t from, std::uint32_t to) const;
  void part_fans(std::uint32_t g, const std::vector<std::uint32_t>& fans);
  void part_pairs(std::span<const std::uint32_t> pairs);
  bool cut_doubled_edges(std::span<const std::uint32_t> crowded, const std::vector<std::uint32_t>& fans);

  std::span<const Vec3> positions_;
  std::span<const IndexedTriangle> triangles_;
  const EdgeGroups& groups_;
  std::vector<std::uint32_t>& opposite_;
};

/// Sorted by angle from the middle of the widest gap on; within the rounding of angles ends of solids come
/// first.
std::vector<Spoke> Pairing::spokes_of(const std::vector<std::uint32_t>& faces) const {
  const auto [low, high] = std::minmax({vertex(faces[0]), vertex(next_in_face(faces[0]))});
  const Vec3 origin = positions_[low], axis = unit(positions_[high] - origin);
  const Vec3 u = unit_perpendicular(axis), v = glm::cross(axis, u);
  std::vector<Spoke> spokes;
  for (const std::uint32_t h : faces) {
    const std::uint32_t apex = vertex(previous_in_face(h));
    const Vec3 w = scaled_to_one(positions_[apex] - origin);
    const Vec3 out = w - axis * glm::dot(w, axis);
    const double angle = std::atan2(glm::dot(out, v) + 0.0, glm::dot(out, u));
    const double error = 4e-15 * glm::length(w) / glm::length(out);
    const bool known = std::isfinite(angle) && std::isfinite(error);
    spokes.push_back({known ? angle : 0.0, known ? error : 0.0, is_forth(h), apex, h});
  }
  const auto whole_order = [](const Spoke& s) {
    return std::tuple(s.angle, !s.ends_solid, s.apex, s.half_edge);
  };
  std::ranges::sort(spokes, {}, whole_order);
  std::size_t widest = 0;
  double width = spokes[0].angle + 2.0 * std::numbers::pi - spokes.back().angle;
  for (std::size_t i = 1; i < spokes.size(); ++i)
    if (const double gap = spokes[i].angle - spokes[i - 1].angle; gap > width) widest = i, width = gap;
  std::rotate(spokes.begin(), spokes.begin() + static_cast<std::ptrdiff_t>(widest), spokes.end());
  for (std::size_t i = spokes.size() - widest; i < spokes.size(); ++i)
    spokes[i].angle += 2.0 * std::numbers::pi;
  for (std::size_t begin = 0, end = 0; begin < spokes.size(); begin = end) {
    for (end = begin + 1; end < spokes.size(); ++end)
      if (spokes[end].angle - spokes[end - 1].angle > spokes[end].error + spokes[end - 1].error) break;
    std::sort(spokes.begin() + static_cast<std::ptrdiff_t>(begin),
              spokes.begin() + static_cast<std::ptrdiff_t>(end), [](const Spoke& a, const Spoke& b) {
                return std::tuple(!a.ends_solid, a.apex, a.half_edge) <
                       std::tuple(!b.ends_solid, b.apex, b.half_edge);
              });
  }
  return spokes;
}

void Pairing::pair_by_angle(const std::vector<std::uint32_t>& faces) {
  if (faces.empty()) return;
  std::vector<Spoke> spokes = spokes_of(faces);
  // Begin where most solids have ended, so that each end has its beginning before it.
  int depth = 0, least = 0;
  std::size_t start = 0;
  for (std::size_t i = 0; i < spokes.size(); ++i) {
    depth += spokes[i].ends_solid ? -1 : 1;
    if (depth < least) least = depth, start = i + 1;
  }
  std::rotate(spokes.begin(), spokes.begin() + static_cast<std::ptrdiff_t>(start % spokes.size()),
              spokes.end());
  std::vector<std::uint32_t> begun;
  for (const Spoke& spoke : spokes) {
    if (!spoke.ends_solid) {
      begun.push_back(spoke.half_edge);
    } else {
      join(spoke.half_edge, begun.back());
      begun.pop_back();
    }
  }
}

/// The half-edges of pairs that run from the lower vertex.
std::vector<std::uint32_t> Pairing::pairs_of(std::uint32_t g) const {
  std::vector<std::uint32_t> pairs;
  for (const std::uint32_t h : groups_[g])
    if (opposite_[h] != kNoHalfEdge && is_forth(h)) pairs.push_back(h);
  std::ranges::sort(pairs, {}, [&](std::uint32_t h) { return std::pair(vertex(previous_in_face(h)), h); });
  return pairs;
}

/// Whether the faces of two half-edges that leave a vertex are joined round it.
bool Pairing::is_one_fan(std::uint32_t from, std::uint32_t to) const {
  std::uint32_t h = from;
  do {
    if (h == to) return true;
    h = opposite_[previous_in_face(h)];
  } while (h != kNoHalfEdge && h != from);
  if (h == from) return false;
  for (h = from; opposite_[h] != kNoHalfEdge;) {
    h = next_in_face(opposite_[h]);
    if (h == to) return true;
  }
  return false;
}

/// Pairs that belong to the same fans at both ends change partners. `fans` are those before any did; they
/// only come apart.
void Pairing::part_fans(std::uint32_t g, const std::vector<std::uint32_t>& fans) {
  std::vector<std::uint32_t> pairs = pairs_of(g);
  const auto ends = [&](std::uint32_t h) { return std::pair(fans[h], fans[opposite_[h]]); };
  std::ranges::stable_sort(pairs, {}, ends);
  for (std::size_t begin = 0, end = 0; begin < pairs.size(); begin = end) {
    for (end = begin + 1; end < pairs.size() && ends(pairs[end]) == ends(pairs[begin]);) ++end;
    part_pairs(std::span(pairs).subspan(begin, end - begin));
  }
}

void Pairing::part_pairs(std::span<const std::uint32_t> pairs) {
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t i = 0; i < pairs.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const std::uint32_t a = pairs[i], b = pairs[j], across_a = opposite_[a], across_b = opposite_[b];
        if (!is_one_fan(a, b) || !is_one_fan(across_a, across_b)) continue;
        join(a, across_b);
        join(b, across_a);
        changed = true;
      }
  }
}

/// Cuts all pairs of an edge where two pairs, or a pair and a face that is not paired, have the same fans at
/// both ends. Returns whether there was one.
bool Pairing::cut_doubled_edges(std::span<const std::uint32_t> crowded,
                                const std::vector<std::uint32_t>& fans) {
  bool any = false;
  for (const std::uint32_t g : crowded) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
    const auto ends = [&](std::uint32_t h) {
      const std::uint32_t begin = fans[h], end = fans[next_in_face(h)];
      return is_forth(h) ? std::pair(begin, end) : std::pair(end, begin);
    };
    const std::vector<std::uint32_t> pairs = pairs_of(g);
    for (const std::uint32_t h : pairs) ++uses[ends(h)];
    for (const std::uint32_t h : groups_[g])
      if (opposite_[h] == kNoHalfEdge)
        if (const auto found = uses.find(ends(h)); found != uses.end()) ++found->second;
    if (std::ranges::none_of(uses, [](const auto& use) { return use.second > 1; })) continue;
    any = true;
    for (const std::uint32_t h : pairs) opposite_[std::exchange(opposite_[h], kNoHalfEdge)] = kNoHalfEdge;
  }
  return any;
}

}  // namespace

void pair_faces(std::span<const Vec3> positions, std::span<const IndexedTriangle> triangles,
                const EdgeGroups& groups, std::span<const std::uint32_t> crowded,
                std::vector<std::uint32_t>& opposite) {
  if (!crowded.empty()) Pairing(positions, triangles, groups, opposite).run(crowded);
}

}  // namespace penumbra::detail
