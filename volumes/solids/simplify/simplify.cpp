#include "volumes/solids/simplify/simplify.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>
#include <queue>

#include "volumes/solids/simplify/face_boxes.h"
#include "volumes/solids/simplify/one_sided_point.h"
#include "volumes/solids/simplify/triangle_conflict.h"

namespace penumbra::detail {
namespace {

using Corners = std::array<Vec3, 3>;

constexpr std::uint32_t kGone = ~0u;
constexpr double kMargin = 2e-4;     ///< of the spacing, see PlacementOptions
constexpr double kRounding = 1e-13;  ///< of the surface's size
constexpr double kThin = 1e-4;       ///< of the spacing: new triangles are higher than this
constexpr double kTurn = 0.1;        ///< cosine of how far a triangle may turn
/// Another pass over all edges follows where one took away more than this share of the triangles.
constexpr double kFewer = 0.01;
constexpr int kMostPasses = 4;
constexpr std::size_t kMostFaces = 40;  ///< around an edge

/// An edge at the time when its cost was found. Later costs are hardly ever less, so that an old cost will do to wait by.
struct Candidate {
  double cost;
  std::uint32_t a, b;
  std::uint32_t version_a, version_b;
  bool operator<(const Candidate& other) const {
    return std::tie(cost, a, b) > std::tie(other.cost, other.a, other.b);  // least on top
  }
};

/// What replaces an edge.
struct Plan {
  Vec3 point;
  double cost;   ///< how much volume changes
  double error;  ///< how far the surface may have moved since the start
};

class Simplifier {
 public:
  Simplifier(IndexedSurface surface, const SimplifyOptions& options)
      : options_(options),
        positions_(std::move(surface.positions)),
        triangles_(std::move(surface.triangles)),
        faces_at_(positions_.size()),
        quadrics_(positions_.size()),
        error_(positions_.size(), 0.0),
        version_(positions_.size(), 0),
        became_(positions_.size()),
        on_side_(positions_.size(), 0),
        boxes_(boxes_of(positions_, triangles_)) {
    std::iota(became_.begin(), became_.end(), 0u);
    const Bounds all = bounds_of(positions_);
    origin_ = all.center();
    rounding_ = kRounding * all.radius();
    for (std::uint32_t f = 0; f < triangles_.size(); ++f) {
      const Corners c = corners(triangles_[f]);
      const Vec3 n = glm::cross(c[1] - c[0], c[2] - c[0]);
      const double twice = glm::length(n);
      for (const std::uint32_t v : triangles_[f]) {
        faces_at_[v].push_back(f);
        if (twice > 0.0) quadrics_[v].add_plane(n / twice, c[0] - origin_, twice);
      }
    }
    for (std::size_t v = 0; v < positions_.size(); ++v)
      for (int k = 0; k < 3; ++k) {
        if (positions_[v][k] == options_.box.low[k]) on_side_[v] |= static_cast<std::uint8_t>(1 << k);
        if (positions_[v][k] == options_.box.high[k]) on_side_[v] |= static_cast<std::uint8_t>(8 << k);
      }
  }

  IndexedSurface run() {
    for (int pass = 0; pass < kMostPasses; ++pass) {
      push_all();
      const auto start = static_cast<double>(queue_.size() + 1);
      const std::size_t before = collapsed_;
      std::size_t steps = 0;
      while (!queue_.empty()) {
        const Candidate c = queue_.top();
        queue_.pop();
        if (++steps % 1024 == 0 && pass == 0)
          report(options_.progress, std::min(1.0, static_cast<double>(steps) / (2.0 * start)));
        look_at(c);
      }
      if (static_cast<double>(collapsed_ - before) < kFewer * static_cast<double>(triangles_.size())) break;
    }
    return result();
  }

 private:
  static Bounds box_of(const Corners& c) {
    Bounds box;
    for (const Vec3& p : c) box.add(p);
    return box;
  }
  static std::vector<Bounds> boxes_of(const std::vector<Vec3>& p,
                                      const std::vector<IndexedTriangle>& triangles) {
    std::vector<Bounds> boxes;
    for (const IndexedTriangle& t : triangles) boxes.push_back(box_of({p[t[0]], p[t[1]], p[t[2]]}));
    return boxes;
  }
  Corners corners(const IndexedTriangle& t) const {
    return {positions_[t[0]], positions_[t[1]], positions_[t[2]]};
  }
  static bool has(const IndexedTriangle& t, std::uint32_t v) { return t[0] == v || t[1] == v || t[2] == v; }

  void push_all() {
    for (const IndexedTriangle& t : triangles_)
      for (int k = 0; k < 3; ++k) {
        const std::uint32_t a = t[k], b = t[(k + 1) % 3];
        if (a == kGone || a > b) continue;
        if (const std::optional<Plan> plan = plan_for(a, b)) push(a, b, plan->cost);
      }
  }
  void push(std::uint32_t a, std::uint32_t b, double cost) {
    queue_.push({cost, a, b, version_[a], version_[b]});
  }
  /// What a vertex has become a part of.
  std::uint32_t current(std::uint32_t v) {
    while (became_[v] != v) v = became_[v] = became_[became_[v]];
    return v;
  }
  bool is_edge(std::uint32_t a, std::uint32_t b) const {
    return std::ranges::any_of(faces_at_[a], [&](std::uint32_t f) { return has(triangles_[f], b); });
  }

  void look_at(const Candidate& c) {
    const std::uint32_t a = std::min(current(c.a), current(c.b)), b = std::max(current(c.a), current(c.b));
    const bool is_old = a != c.a || b != c.b || version_[a] != c.version_a || version_[b] != c.version_b;
    if (a == b || (is_old && !is_edge(a, b))) return;
    const std::optional<Plan> plan = plan_for(a, b);
    if (!plan) return;
    if (is_old && !queue_.empty() && plan->cost > queue_.top().cost) return push(a, b, plan->cost);
    if (is_allowed(a, b, plan->point)) collapse(a, b, *plan);
  }

  std::optional<Plan> plan_for(std::uint32_t a, std::uint32_t b) {
    const std::uint8_t sides = on_side_[a] | on_side_[b];
    if ((sides & 7 & sides >> 3) != 0) return std::nullopt;
    PlacementOptions placement{.rounding = rounding_, .margin = kMargin * options_.spacing};
    Vec3 start = 0.5 * (positions_[a] + positions_[b]) - origin_;
    for (int k = 0; k < 3; ++k) {
      const bool low = sides >> k & 1, high = sides >> (k + 3) & 1;
      placement.fixed[k] = low || high;
      if (low || high) start[k] = (low ? options_.box.low[k] : options_.box.high[k]) - origin_[k];
    }
    // Limits by the triangles around; those in sides of the box bound nothing, the point stays there.
    limits_.clear();
    areas_.clear();
    const double sign = options_.side == SimplifyOptions::Side::kOutward ? -1.0 : 1.0;
    for (const std::uint32_t v : {a, b})
      for (const std::uint32_t f : faces_at_[v]) {
        if (v == b && has(triangles_[f], a)) continue;
        if (side_of(triangles_[f]) != 0) continue;
        const Corners c = corners(triangles_[f]);
        const Vec3 n = glm::cross(c[1] - c[0], c[2] - c[0]);
        const double twice = glm::length(n);
        if (!(twice > 0.0)) return std::nullopt;
        limits_.push_back({sign / twice * n, sign / twice * glm::dot(n, c[0] - origin_)});
        areas_.push_back(0.5 * twice);
      }
    if (limits_.size() > kMostFaces) return std::nullopt;
    Quadric quadric = quadrics_[a];
    quadric += quadrics_[b];
    const std::span<const PlaneLimit> bounds(limits_);
    const std::optional<Vec3> x =
        place_one_sided(quadric, options_.side == SimplifyOptions::Side::kEither ? bounds.first(0) : bounds,
                        start, placement);
    if (!x) return std::nullopt;
    Plan plan{*x + origin_, 0.0, 0.0};
    for (int k = 0; k < 3; ++k)
      if (placement.fixed[k]) plan.point[k] = sides >> k & 1 ? options_.box.low[k] : options_.box.high[k];
    for (int k = 0; k < 3; ++k)
      if (plan.point[k] < options_.box.low[k] || plan.point[k] > options_.box.high[k]) return std::nullopt;
    double most = 0.0;
    for (std::size_t i = 0; i < limits_.size(); ++i) {
      const double by = std::abs(glm::dot(limits_[i].normal, *x) - limits_[i].offset);
      plan.cost += areas_[i] * by / 3.0;
      most = std::max(most, by);
    }
    plan.error = std::max(error_[a], error_[b]) + most;
    if (!(plan.error <= options_.tolerance)) return std::nullopt;
    // Among collapses that change nothing, short edges first.
    plan.cost += 1e-9 * options_.spacing * options_.spacing * glm::distance(positions_[a], positions_[b]);
    return plan;
  }

  /// Bits of the sides of the box that a triangle lies in.
  std::uint8_t side_of(const IndexedTriangle& t) const {
    return on_side_[t[0]] & on_side_[t[1]] & on_side_[t[2]];
  }

  /// The surface stays a two-manifold, no triangle is turned or made thin, none meets another.
  bool is_allowed(std::uint32_t a, std::uint32_t b, const Vec3& point) {
    if (!joins_two_triangles_only(a, b)) return false;
    for (const std::uint32_t v : {a, b})
      for (const std::uint32_t f : faces_at_[v]) {
        const IndexedTriangle& t = triangles_[f];
        if (has(t, a) && has(t, b)) continue;
        const Corners old = corners(t);
        Corners now = old;
        for (int k = 0; k < 3; ++k)
          if (t[k] == v) now[k] = point;
        if (!keeps_its_shape(old, now)) return false;
      }
    for (const std::uint32_t v : {a, b})
      for (const std::uint32_t f : faces_at_[v])
        if (!(has(triangles_[f], a) && has(triangles_[f], b)) && meets_others(f, a, b, point)) return false;
    return true;
  }

  bool joins_two_triangles_only(std::uint32_t a, std::uint32_t b) {
    neighbors_.clear();
    for (const std::uint32_t f : faces_at_[a])
      for (const std::uint32_t v : triangles_[f])
        if (v != a && v != b) neighbors_.push_back(v);
    std::sort(neighbors_.begin(), neighbors_.end());
    neighbors_.erase(std::unique(neighbors_.begin(), neighbors_.end()), neighbors_.end());
    std::size_t common = 0, around = 0;
    others_.clear();
    for (const std::uint32_t f : faces_at_[b])
      for (const std::uint32_t v : triangles_[f])
        if (v != a && v != b) others_.push_back(v);
    std::sort(others_.begin(), others_.end());
    others_.erase(std::unique(others_.begin(), others_.end()), others_.end());
    for (const std::uint32_t v : others_) common += std::ranges::binary_search(neighbors_, v) ? 1 : 0;
    around = neighbors_.size() + others_.size() - common;
    return common == 2 && around >= 4;
  }

  bool keeps_its_shape(const Corners& old, const Corners& now) const {
    const Vec3 before = glm::cross(old[1] - old[0], old[2] - old[0]),
               after = glm::cross(now[1] - now[0], now[2] - now[0]);
    const double twice = glm::length(after);
    const double longest = std::max(
        {glm::distance(now[0], now[1]), glm::distance(now[1], now[2]), glm::distance(now[2], now[0])});
    return twice > kThin * options_.spacing * longest &&
           glm::dot(before, after) > kTurn * glm::length(before) * twice;
  }

  /// Triangle f with its corner a or b moved meets a triangle that is not around the edge, or one that is, moved as well.
  bool meets_others(std::uint32_t f, std::uint32_t a, std::uint32_t b, const Vec3& point) const {
    const auto moved = [&](const IndexedTriangle& t, IndexedTriangle& named) {
      Corners c = corners(t);
      named = t;
      for (int k = 0; k < 3; ++k)
        if (t[k] == a || t[k] == b) {
          c[k] = point;
          named[k] = a;
        }
      return c;
    };
    IndexedTriangle mine, theirs;
    const Corners c = moved(triangles_[f], mine);
    const Vec3 n = glm::cross(c[1] - c[0], c[2] - c[0]);
    return !boxes_.for_each(box_of(c), n, glm::dot(n, c[0]), [&](std::uint32_t g) {
      const IndexedTriangle& t = triangles_[g];
      if (g == f || (has(t, a) && has(t, b))) return true;
      const Corners d = moved(t, theirs);
      return !are_in_conflict(c, mine, d, theirs);
    });
  }

  void collapse(std::uint32_t a, std::uint32_t b, const Plan& plan) {
    positions_[a] = plan.point;
    error_[a] = plan.error;
    quadrics_[a] += quadrics_[b];
    on_side_[a] |= on_side_[b];
    for (const std::uint32_t f : faces_at_[b]) {
      IndexedTriangle& t = triangles_[f];
      if (has(t, a)) {
        for (const std::uint32_t v : t)
          if (v != b) std::erase(faces_at_[v], f);
        boxes_.set(f, Bounds{});
        t = {kGone, kGone, kGone};
        continue;
      }
      for (std::uint32_t& v : t)
        if (v == b) v = a;
      faces_at_[a].push_back(f);
    }
    faces_at_[b].clear();
    became_[b] = a;
    ++version_[a];
    ++collapsed_;
    for (const std::uint32_t f : faces_at_[a]) boxes_.set(f, box_of(corners(triangles_[f])));
  }

  IndexedSurface result() const {
    IndexedSurface out;
    std::vector<std::uint32_t> number(positions_.size(), kGone);
    for (const IndexedTriangle& t : triangles_) {
      if (t[0] == kGone) continue;
      IndexedTriangle named;
      for (int k = 0; k < 3; ++k) {
        std::uint32_t& n = number[t[k]];
        if (n == kGone) {
          n = static_cast<std::uint32_t>(out.positions.size());
          out.positions.push_back(positions_[t[k]]);
        }
        named[k] = n;
      }
      out.triangles.push_back(named);
    }
    return out;
  }

  const SimplifyOptions& options_;
  std::vector<Vec3> positions_;
  std::vector<IndexedTriangle> triangles_;
  std::vector<std::vector<std::uint32_t>> faces_at_;
  std::vector<Quadric> quadrics_;
  std::vector<double> error_;  ///< how far the surface at a vertex may have moved
  std::vector<std::uint32_t> version_;
  std::vector<std::uint32_t> became_;  ///< the vertex that a vertex was joined to, or itself
  std::size_t collapsed_ = 0;
  std::vector<std::uint8_t> on_side_;  ///< bits of the box's sides
  FaceBoxes boxes_;
  Vec3 origin_{0.0};
  double rounding_ = 0.0;
  std::priority_queue<Candidate> queue_;
  std::vector<PlaneLimit> limits_;
  std::vector<double> areas_;
  std::vector<std::uint32_t> neighbors_, others_;
};

}  // namespace

IndexedSurface simplify(IndexedSurface surface, const SimplifyOptions& options) {
  return Simplifier(std::move(surface), options).run();
}

}  // namespace penumbra::detail
