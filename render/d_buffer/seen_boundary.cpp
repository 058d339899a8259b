#include "render/d_buffer/seen_boundary.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace penumbra::detail {
namespace {

// All as in d_buffer_boundary.glsl and disk_area.glsl.

constexpr std::uint32_t kNoEdge = ~0u;
constexpr int kMostSteps = 16;

double cross2(const glm::dvec2& p, const glm::dvec2& q) {
  return p.x * q.y - p.y * q.x;
}

Chord chord_of(const Vec3& plane) {
  const double size = std::hypot(plane.x, plane.y);
  return {size > 0.0 ? glm::dvec2(plane) / size : glm::dvec2(1.0, 0.0), plane.z / size};
}

/// The opposite of disk_area.h's, since light space is a mirror image of the world.
Vec3 plane_of_edge(const Vec3& x, const Vec3& a, const Vec3& b) {
  const Vec3 from_a = a - x, from_b = b - x;
  return glm::cross(b - a, glm::dot(from_a, from_a) < glm::dot(from_b, from_b) ? from_a : from_b);
}

glm::dvec2 on_disk(Vec3 v, Vec3 w, const Vec3& x) {
  v -= x;
  w -= x;
  const double least = std::max(0.001 * (std::abs(v.x) + std::abs(v.y)), 1e-9 * w.z);
  if (v.z < least) {
    const double t = (w.z - least) / (w.z - v.z);
    v = w.z > least ? Vec3(glm::dvec2(w) + t * (glm::dvec2(v) - glm::dvec2(w)), least) : w.z > v.z ? w : v;
  }
  return glm::dvec2(v) / v.z;
}

glm::dvec2 leave(const glm::dvec2& p, const glm::dvec2& way) {
  const glm::dvec2 d = glm::normalize(way);
  const double along = glm::dot(p, d);
  return p + d * (std::sqrt(std::max(0.0, along * along + 1.0 - glm::dot(p, p))) - along);
}

bool meets_disk(const glm::dvec2& p, const glm::dvec2& q) {
  const glm::dvec2 d = q - p;
  const double along = -glm::dot(p, d), area = cross2(p, d), length2 = glm::dot(d, d);
  return along > 0.0 && area * area < length2 && (along < length2 || glm::dot(q, q) < 1.0);
}

bool on_arc(const glm::dvec2& from, const glm::dvec2& to, const glm::dvec2& p) {
  return cross2(from, to) >= 0.0 ? cross2(from, p) >= 0.0 && cross2(p, to) >= 0.0
                                 : !(cross2(to, p) > 0.0 && cross2(p, from) > 0.0);
}

bool is_inside(const Chord& chord, const glm::dvec2& p) {
  return glm::dot(chord.normal, p) + chord.delta >= 0.0;
}

/// Whether the path crosses the ray from p along the first axis an odd number of times.
bool crosses_oddly(const std::vector<glm::dvec2>& path, const glm::dvec2& p) {
  bool odd = false;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const glm::dvec2 a = path[i - 1] - p, b = path[i] - p;
    if ((a.y > 0.0) != (b.y > 0.0) && (cross2(a, b) > 0.0) == (b.y > a.y)) odd = !odd;
  }
  return odd;
}

double twice_area(const std::vector<glm::dvec2>& path) {
  double sum = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) sum += cross2(path[i - 1], path[i]);
  return sum;
}

}  // namespace

SeenBoundary::SeenBoundary(std::span<const glm::vec4> records, EntryUse use, const Vec3& x, bool hidden)
    : records_(records), is_followed_(use.is_followed()) {
  const Vec3 a(records[4 * use.facet() + 1]), b(records[4 * use.facet() + 2]);
  chord_ = chord_of(plane_of_edge(x, a, b));
  if (!is_followed_) {
    chord_.delta = hidden ? std::min(chord_.delta, 0.0) : std::max(chord_.delta, 0.0);
    return;
  }
  const glm::dvec2 way = on_disk(b, a, x) - on_disk(a, b, x);
  left_is_lit_ = cross2(way, chord_.normal) > 0.0;
  on_ = walk(use.facet(), true, way, a, b, x);
  if (!on_.closed)
    back_ = walk(use.facet(), false, -way, b, a, x);
  else if (!(twice_area(on_.points) > 0.0))
    left_is_lit_ = !left_is_lit_;
}

SeenBoundary::Walk SeenBoundary::walk(std::uint32_t facet, bool on, const glm::dvec2& along, Vec3 a, Vec3 b,
                                      const Vec3& x) const {
  const auto beyond = [&](std::uint32_t f) { return records_[4 * f + (on ? 3 : 0)]; };
  const auto link = [](const glm::vec4& record) { return static_cast<std::uint32_t>(record.w - 0.5f); };
  Walk w;
  w.points = {-chord_.delta * chord_.normal};
  w.last = facet, w.next = kNoEdge;
  glm::dvec2 way = along, pb = on_disk(b, a, x);
  glm::vec4 far = beyond(facet);
  for (int i = 0; i < kMostSteps && far.w > 0.5f && glm::dot(pb, pb) < 1.0; ++i) {
    w.points.push_back(pb);
    w.last = link(far);
    w.closed = w.last == facet;
    if (w.closed) {
      w.points.push_back(w.points.front());
      return w;
    }
    a = b;
    b = Vec3(far);
    pb = on_disk(b, a, x);
    way = pb - w.points.back();
    far = beyond(w.last);
  }
  const Vec3 c(far);
  if (far.w > 0.5f && glm::dot(pb, pb) >= 1.0 && meets_disk(pb, on_disk(c, b, x))) {
    w.next = link(far);
    w.again = chord_of(on ? plane_of_edge(x, b, c) : plane_of_edge(x, c, b));
    w.adds = glm::dot(on ? plane_of_edge(x, a, b) : plane_of_edge(x, b, a), c - x) < 0.0;
  }
  w.points.push_back(leave(w.points.back(), way));
  return w;
}

/// On the left of the boundary, which the circle closes from where it leaves to where it comes in.
bool SeenBoundary::is_left(const glm::dvec2& p) const {
  const glm::dvec2 rim(std::sqrt(std::max(0.0, 1.0 - p.y * p.y)), p.y);
  return on_arc(on_.points.back(), back_.points.back(), rim) !=
         (crosses_oddly(on_.points, p) != crosses_oddly(back_.points, p));
}

bool SeenBoundary::is_lit(const glm::dvec2& p) const {
  if (!is_followed_) return is_inside(chord_, p);
  if (on_.closed) return crosses_oddly(on_.points, p) == left_is_lit_;
  bool lit = is_left(p) == left_is_lit_;
  const bool meet = on_.next != kNoEdge && on_.next == back_.last;  // round a corner outside of the disk
  const bool twice = on_.next == back_.next;
  const auto come_again = [&](const Walk& w) {
    lit = w.adds ? lit || is_inside(*w.again, p) : lit && is_inside(*w.again, p);
  };
  if (on_.again && !meet) come_again(on_);
  if (back_.again && !meet && !twice) come_again(back_);
  return lit;
}

SeenEntries::SeenEntries(std::span<const glm::vec4> records, std::span<const EntryUse> uses, const Vec3& x,
                         bool hidden)
    : is_umbra_(uses[0].is_umbra() || uses[1].is_umbra()), hidden_(hidden) {
  if (!uses[0].is_none()) first_.emplace(records, uses[0], x, hidden);
  if (!uses[1].is_none()) second_.emplace(records, uses[1], x, hidden);
}

/// Two penumbra entries are two occluders, two umbra entries two sides of one.
bool SeenEntries::is_lit(const glm::dvec2& point) const {
  if (!first_ && !second_) return !hidden_;
  if (!first_ || !second_) return (first_ ? first_ : second_)->is_lit(point);
  return is_umbra_ ? first_->is_lit(point) || second_->is_lit(point)
                   : first_->is_lit(point) && second_->is_lit(point);
}

}  // namespace penumbra::detail
