#include "volumes/solids/simplify/box_collapses.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "volumes/solids/simplify/triangle_conflict.h"

namespace penumbra::detail {
namespace {

using Corners = std::array<Vec3, 3>;

constexpr std::uint32_t kGone = ChangingSurface::kGone;
constexpr double kThin = 1e-4;  ///< of the spacing: new triangles are higher than this
constexpr double kTurn = 0.1;   ///< cosine of how far a triangle may turn

Bounds box_of(const Corners& c) {
  Bounds box;
  for (const Vec3& p : c) box.add(p);
  return box;
}

bool keeps_its_shape(const Corners& old, const Corners& now, double spacing) {
  const Vec3 before = glm::cross(old[1] - old[0], old[2] - old[0]),
             after = glm::cross(now[1] - now[0], now[2] - now[0]);
  const double twice = glm::length(after);
  const double longest =
      std::max({glm::distance(now[0], now[1]), glm::distance(now[1], now[2]), glm::distance(now[2], now[0])});
  return twice > kThin * spacing * longest && glm::dot(before, after) > kTurn * glm::length(before) * twice;
}

void keep_one_each(std::vector<std::uint32_t>& list) {
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

}  // namespace

BoxedSurface boxed(ChangingSurface& surface, const DisjointBoxes& boxes) {
  BoxedSurface out{.surface = surface,
                   .boxes = boxes,
                   .box_of = std::vector<std::uint32_t>(surface.positions.size(), kGone),
                   .crossing = {},
                   .place = std::vector<std::uint32_t>(surface.triangles.size(), kGone)};
  for (std::uint32_t i = 0; i < boxes.count(); ++i)
    for (const std::uint32_t v : boxes.points(i)) out.box_of[v] = i;
  for (std::uint32_t f = 0; f < surface.triangles.size(); ++f) {
    const IndexedTriangle& t = surface.triangles[f];
    if (t[0] == kGone) continue;
    if (out.box_of[t[0]] != out.box_of[t[1]] || out.box_of[t[0]] != out.box_of[t[2]])
      out.crossing.push_back(f);
  }
  return out;
}

BoxCollapses::BoxCollapses(BoxedSurface& all, std::uint32_t box)
    : all_(all), surface_(all.surface), box_(box), planner_(all.surface) {
  for (const std::uint32_t v : all.boxes.points(box))
    for (const std::uint32_t f : surface_.faces_at[v]) {
      const IndexedTriangle& t = surface_.triangles[f];
      if (!is_inside(t) || v != std::min({t[0], t[1], t[2]})) continue;
      all.place[f] = static_cast<std::uint32_t>(faces_.size());
      faces_.push_back(f);
    }
  inside_ = faces_.size();
  const Bounds& own = all.boxes.box(box);
  for (const std::uint32_t f : all.crossing)
    if (overlap(own, box_of(surface_.corners(surface_.triangles[f])))) faces_.push_back(f);
  std::vector<Bounds> boxes;
  for (const std::uint32_t f : faces_) boxes.push_back(box_of(surface_.corners(surface_.triangles[f])));
  face_boxes_ = FaceBoxes(std::move(boxes));
}

bool BoxCollapses::is_inside(const IndexedTriangle& t) const {
  return std::ranges::all_of(t, [&](std::uint32_t v) { return all_.box_of[v] == box_; });
}

bool BoxCollapses::is_free(std::uint32_t v) const {
  return std::ranges::all_of(surface_.faces_at[v],
                             [&](std::uint32_t f) { return is_inside(surface_.triangles[f]); });
}

std::size_t BoxCollapses::run() {
  for (std::size_t i = 0; i < inside_; ++i) {
    const IndexedTriangle t = surface_.triangles[faces_[i]];
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k], b = t[(k + 1) % 3];
      if (a > b || !is_free(a) || !is_free(b)) continue;
      if (const std::optional<CollapsePlan> plan = planner_.plan_for(a, b)) push(a, b, plan->cost);
    }
  }
  while (!queue_.empty()) {
    const Candidate c = queue_.top();
    queue_.pop();
    look_at(c);
  }
  return collapsed_;
}

void BoxCollapses::push(std::uint32_t a, std::uint32_t b, double cost) {
  queue_.push({cost, a, b, surface_.version[a], surface_.version[b]});
}

/// What a vertex has become a part of.
std::uint32_t BoxCollapses::current(std::uint32_t v) {
  std::vector<std::uint32_t>& became = surface_.became;
  while (became[v] != v) v = became[v] = became[became[v]];
  return v;
}

void BoxCollapses::look_at(const Candidate& c) {
  const std::uint32_t a = std::min(current(c.a), current(c.b)), b = std::max(current(c.a), current(c.b));
  const bool is_old =
      a != c.a || b != c.b || surface_.version[a] != c.version_a || surface_.version[b] != c.version_b;
  if (a == b || (is_old && !surface_.is_edge(a, b))) return;
  const std::optional<CollapsePlan> plan = planner_.plan_for(a, b);
  if (!plan) return;
  if (is_old && !queue_.empty() && plan->cost > queue_.top().cost) return push(a, b, plan->cost);
  if (is_allowed(a, b, plan->point)) collapse(a, b, *plan);
}

/// The surface stays a two-manifold and in the box, no triangle is turned or made thin, none meets another.
bool BoxCollapses::is_allowed(std::uint32_t a, std::uint32_t b, const Vec3& point) {
  return all_.boxes.contains(box_, point) && joins_two_triangles_only(a, b) && find_moved(a, b, point) &&
         !meets_others(a, b);
}

bool BoxCollapses::joins_two_triangles_only(std::uint32_t a, std::uint32_t b) {
  const auto gather = [&](std::uint32_t center, std::vector<std::uint32_t>& around) {
    around.clear();
    for (const std::uint32_t f : surface_.faces_at[center])
      for (const std::uint32_t v : surface_.triangles[f])
        if (v != a && v != b) around.push_back(v);
    keep_one_each(around);
  };
  gather(a, neighbors_);
  gather(b, others_);
  const auto common = static_cast<std::size_t>(std::ranges::count_if(
      others_, [&](std::uint32_t v) { return std::ranges::binary_search(neighbors_, v); }));
  return common == 2 && neighbors_.size() + others_.size() - common >= 4;
}

bool BoxCollapses::find_moved(std::uint32_t a, std::uint32_t b, const Vec3& point) {
  moved_.clear();
  for (const std::uint32_t v : {a, b})
    for (const std::uint32_t f : surface_.faces_at[v]) {
      const IndexedTriangle& t = surface_.triangles[f];
      if (has(t, a) && has(t, b)) continue;
      const Corners old = surface_.corners(t);
      Moved m{t, old, {}};
      for (int k = 0; k < 3; ++k)
        if (t[k] == v) {
          m.corners[k] = point;
          m.named[k] = a;
        }
      if (!keeps_its_shape(old, m.corners, surface_.options.spacing)) return false;
      m.box = box_of(m.corners);
      moved_.push_back(m);
    }
  return true;
}

bool BoxCollapses::meets_others(std::uint32_t a, std::uint32_t b) const {
  Bounds whole;
  for (const Moved& m : moved_) whole.add(m.box);
  const bool clear = face_boxes_.for_each(whole, [&](std::uint32_t place) {
    const IndexedTriangle& t = surface_.triangles[faces_[place]];
    if (has(t, a) || has(t, b)) return true;
    const Corners c = surface_.corners(t);
    const Bounds box = box_of(c);
    return std::ranges::none_of(moved_, [&](const Moved& m) {
      return overlap(box, m.box) && are_in_conflict(m.corners, m.named, c, t);
    });
  });
  if (!clear) return true;
  for (std::size_t i = 0; i < moved_.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (are_in_conflict(moved_[i].corners, moved_[i].named, moved_[k].corners, moved_[k].named))
        return true;
  return false;
}

void BoxCollapses::collapse(std::uint32_t a, std::uint32_t b, const CollapsePlan& plan) {
  for (const std::uint32_t f : surface_.faces_at[b])
    if (has(surface_.triangles[f], a)) face_boxes_.set(all_.place[f], Bounds{});
  surface_.collapse(a, b, plan.point, plan.error);
  for (const std::uint32_t f : surface_.faces_at[a])
    face_boxes_.set(all_.place[f], box_of(surface_.corners(surface_.triangles[f])));
  ++collapsed_;
}

}  // namespace penumbra::detail
