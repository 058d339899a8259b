// Quickhull (Barber, Dobkin, Huhdanpaa, "The quickhull algorithm for convex hulls", 1996) over points of
// which only exact signs are asked, so that coplanar and nearly coplanar points need no tolerance.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <tuple>
#include <vector>

#include "penumbra/mesh/types.h"
#include "penumbra/volumes/predicates/predicates.h"

namespace penumbra::detail {

/// `Points` supplies `count()`, the exact predicates `orient3d(a, b, c, d)` and `collinear(a, b, c)` of its
/// points by index, and `rounded(i)`, a position that only chooses which point is tried first. `run()`
/// returns what convex_hull (convex_hull.h) does, at the cost stated there.
template <class Points>
class Quickhull {
 public:
  explicit Quickhull(const Points& points)
      : points_(points),
        next_(static_cast<std::size_t>(points.count()), kNoIndex),
        facet_from_(next_.size(), kNoIndex) {}

  std::vector<IndexedTriangle> run() {
    const auto simplex = find_simplex();
    if (!simplex) return {};
    start_from(*simplex);
    while (!pending_.empty()) {
      const int facet = pending_.back();
      pending_.pop_back();
      if (facets_[facet].alive && facets_[facet].first_outside != kNoIndex) add_farthest_point_of(facet);
    }
    return living_facets();
  }

 private:
  static constexpr int kNoIndex = -1;

  /// A facet of the hull so far. Points beyond it form a list threaded through `next_`; each point is in one
  /// list at most.
  struct Facet {
    std::array<int, 3> corner;
    std::array<int, 3> neighbor{kNoIndex, kNoIndex, kNoIndex};  ///< across corner[i] → corner[i + 1]
    int first_outside = kNoIndex;
    int farthest = kNoIndex;
    double farthest_height = -1.0;
    Vec3 normal{0.0};  ///< rounded, only to choose which point comes next
    bool alive = true;
  };

  struct HorizonEdge {
    int from, to;  ///< as the facet that is going runs along it
    int neighbor;  ///< the facet beyond, which stays
  };

  // ---- the first tetrahedron
  // --------------------------------------------------------------------------------------

  template <class Height>
  int farthest_by(Height height) const {
    int best = 0;
    double best_height = -1.0;
    for (int i = 0; i < count(); ++i) {
      if (const double h = height(at(i)); h > best_height) best = i, best_height = h;
    }
    return best;
  }

  /// Four affinely independent points, far apart where rounded arithmetic says so; where it finds none, exact
  /// search.
  std::optional<std::array<int, 4>> find_simplex() const {
    if (count() < 4) return std::nullopt;
    int lowest = 0;
    for (int i = 1; i < count(); ++i) {
      const Vec3 &p = at(i), &q = at(lowest);
      if (std::tie(p.x, p.y, p.z) < std::tie(q.x, q.y, q.z)) lowest = i;
    }
    const Vec3& a = at(lowest);
    const int second = farthest_by([&](const Vec3& p) { return glm::dot(p - a, p - a); });
    const Vec3 along = at(second) - a;
    const auto from_line = [&](const Vec3& p) {
      const Vec3 n = glm::cross(along, p - a);
      return glm::dot(n, n);
    };
    const int third =
        first_that(farthest_by(from_line), [&](int i) { return !points_.collinear(lowest, second, i); });
    if (third == kNoIndex) return std::nullopt;
    const Vec3 normal = glm::cross(along, at(third) - a);
    const auto from_plane = [&](const Vec3& p) { return std::abs(glm::dot(normal, p - a)); };
    const auto off_plane = [&](int i) { return points_.orient3d(lowest, second, third, i) != Sign::kZero; };
    const int fourth = first_that(farthest_by(from_plane), off_plane);
    if (fourth == kNoIndex) return std::nullopt;
    return std::array{lowest, second, third, fourth};
  }

  template <class Condition>
  int first_that(int guess, Condition condition) const {
    if (condition(guess)) return guess;
    for (int i = 0; i < count(); ++i) {
      if (condition(i)) return i;
    }
    return kNoIndex;
  }

  void start_from(std::array<int, 4> s) {
    if (points_.orient3d(s[0], s[1], s[2], s[3]) == Sign::kPositive) std::swap(s[1], s[2]);
    // Now s[3] is behind (s0, s1, s2); the other facets follow from that.
    const std::array<std::array<int, 3>, 4> corners{
        {{s[0], s[1], s[2]}, {s[0], s[3], s[1]}, {s[1], s[3], s[2]}, {s[2], s[3], s[0]}}};
    for (const auto& c : corners) add_facet(c);
    for (int f = 0; f < 4; ++f) {
      for (int i = 0; i < 3; ++i)
        facets_[f].neighbor[i] = facet_along(facets_[f].corner[(i + 1) % 3], facets_[f].corner[i]);
    }
    for (int p = 0; p < count(); ++p) {
      if (std::find(s.begin(), s.end(), p) == s.end()) assign(p, 0, 4);
    }
    for (int f = 0; f < 4; ++f) pending_.push_back(f);
  }

  int facet_along(int from, int to) const {
    for (int f = 0; f < 4; ++f) {
      for (int i = 0; i < 3; ++i) {
        if (facets_[f].corner[i] == from && facets_[f].corner[(i + 1) % 3] == to) return f;
      }
    }
    return kNoIndex;
  }

  // ---- growing
  // ----------------------------------------------------------------------------------------------------

  int count() const { return points_.count(); }
  const Vec3& at(int i) const { return points_.rounded(i); }

  bool sees(int point, const Facet& f) const {
    return points_.orient3d(f.corner[0], f.corner[1], f.corner[2], point) == Sign::kPositive;
  }

  int add_facet(const std::array<int, 3>& corner) {
    Facet f{.corner = corner};
    const Vec3& a = at(corner[0]);
    f.normal = glm::cross(at(corner[1]) - a, at(corner[2]) - a);
    facets_.push_back(f);
    return static_cast<int>(facets_.size()) - 1;
  }

  /// Puts a point on the list of one of the facets [begin, end) that it is beyond; a point beyond none is
  /// inside for good.
  void assign(int point, int begin, int end) {
    for (int i = begin; i < end; ++i) {
      Facet& f = facets_[i];
      if (!sees(point, f)) continue;
      next_[point] = f.first_outside;
      f.first_outside = point;
      const double height = glm::dot(f.normal, at(point) - at(f.corner[0]));
      if (f.farthest == kNoIndex || height > f.farthest_height)
        f.farthest = point, f.farthest_height = height;
      return;
    }
  }

  void add_farthest_point_of(int facet) {
    const int apex = facets_[facet].farthest;
    find_horizon(apex, facet);
    // 1. A fan from the apex over the horizon, which is one simple cycle: strictly visible facets form a
    // disk.
    const int begin = static_cast<int>(facets_.size());
    for (const HorizonEdge& edge : horizon_) {
      const int f = add_facet({edge.from, edge.to, apex});
      facets_[f].neighbor[0] = edge.neighbor;
      facet_from_[edge.from] = f;
      Facet& beyond = facets_[edge.neighbor];
      for (int i = 0; i < 3; ++i) {
        if (beyond.corner[i] == edge.to && beyond.corner[(i + 1) % 3] == edge.from) beyond.neighbor[i] = f;
      }
    }
    const int end = static_cast<int>(facets_.size());
    for (int f = begin; f < end; ++f) {
      const int following = facet_from_[facets_[f].corner[1]];
      facets_[f].neighbor[1] = following;
      facets_[following].neighbor[2] = f;
    }
    // 2. Points that were beyond the facets that went are beyond one of the new ones, or inside.
    for (const int gone : visible_) {
      for (int p = facets_[gone].first_outside; p != kNoIndex;) {
        const int following = next_[p];
        if (p != apex) assign(p, begin, end);
        p = following;
      }
    }
    for (int f = begin; f < end; ++f) {
      if (facets_[f].first_outside != kNoIndex) pending_.push_back(f);
    }
  }

  /// Marks the facets that `apex` sees as dead, starting at one of them, and collects the edges around them.
  void find_horizon(int apex, int start) {
    visible_.assign(1, start);
    horizon_.clear();
    facets_[start].alive = false;
    for (std::size_t i = 0; i < visible_.size(); ++i) {
      const Facet gone = facets_[visible_[i]];
      for (int k = 0; k < 3; ++k) {
        Facet& other = facets_[gone.neighbor[k]];
        if (!other.alive) continue;
        if (sees(apex, other)) {
          other.alive = false;
          visible_.push_back(gone.neighbor[k]);
        }
      }
    }
    for (const int f : visible_) {
      for (int k = 0; k < 3; ++k) {
        const int other = facets_[f].neighbor[k];
        if (!facets_[other].alive) continue;
        horizon_.push_back({facets_[f].corner[k], facets_[f].corner[(k + 1) % 3], other});
      }
    }
  }

  std::vector<IndexedTriangle> living_facets() const {
    std::vector<IndexedTriangle> result;
    for (const Facet& f : facets_) {
      if (!f.alive) continue;
      result.push_back({static_cast<std::uint32_t>(f.corner[0]), static_cast<std::uint32_t>(f.corner[1]),
                        static_cast<std::uint32_t>(f.corner[2])});
    }
    return result;
  }

  const Points& points_;
  std::vector<int> next_;        ///< per point: the next on its facet's list
  std::vector<int> facet_from_;  ///< per point: the new facet whose horizon edge starts there
  std::vector<Facet> facets_;
  std::vector<int> pending_, visible_;
  std::vector<HorizonEdge> horizon_;
};

}  // namespace penumbra::detail
