#include "mesh/polygons/square_triangulation.h"

namespace penumbra::detail {

SquareTriangulation::SquareTriangulation(std::span<const Vec2> points) {
  points_ = {{-4, -4}, {4, -4}, {4, 4}, {-4, 4}};
  points_.insert(points_.end(), points.begin(), points.end());
  at_.assign(points_.size(), 0);
  triangles_.resize(2);
  set(0, {0, 1, 2}, {kNoTriangle, 1, kNoTriangle});
  set(1, {0, 2, 3}, {kNoTriangle, kNoTriangle, 0});
  for (std::uint32_t p = kFrame; p < points_.size(); ++p) insert_point(p);
}

void SquareTriangulation::set(std::uint32_t t, const IndexedTriangle& v,
                              const std::array<std::uint32_t, 3>& n) {
  triangles_[t] = {v, n};
  for (const std::uint32_t vertex : v) at_[vertex] = t;
}

void SquareTriangulation::relink(std::uint32_t t, std::uint32_t from, std::uint32_t to) {
  if (t != kNoTriangle) triangles_[t].n[back_from(t, from)] = to;
}

/// A walk towards p. It begins at a side chosen at random, so that it cannot go round for ever.
std::uint32_t SquareTriangulation::locate(std::uint32_t p) {
  for (std::uint32_t t = last_;;) {
    random_ = random_ * 1664525u + 1013904223u;
    std::uint32_t next = kNoTriangle;
    for (std::uint32_t i = 0; i < 3 && next == kNoTriangle; ++i) {
      const std::uint32_t k = (i + (random_ >> 16)) % 3;
      const IndexedTriangle& v = triangles_[t].v;
      if (turn(v[(k + 1) % 3], v[(k + 2) % 3], p) < 0) next = triangles_[t].n[k];
    }
    if (next == kNoTriangle) return last_ = t;
    t = next;
  }
}

void SquareTriangulation::insert_point(std::uint32_t p) {
  const std::uint32_t t = locate(p);
  const IndexedTriangle& v = triangles_[t].v;
  std::uint32_t on = 3;
  for (std::uint32_t k = 0; k < 3; ++k)
    if (turn(v[(k + 1) % 3], v[(k + 2) % 3], p) == 0) on = k;
  if (on == 3)
    split_triangle(t, p);
  else
    split_side({t, on}, p);
  make_delaunay(p);
}

void SquareTriangulation::split_triangle(std::uint32_t t, std::uint32_t p) {
  const auto [v, n] = triangles_[t];
  const auto t1 = static_cast<std::uint32_t>(triangles_.size()), t2 = t1 + 1;
  triangles_.resize(triangles_.size() + 2);
  set(t, {p, v[1], v[2]}, {n[0], t1, t2});
  set(t1, {p, v[2], v[0]}, {n[1], t2, t});
  set(t2, {p, v[0], v[1]}, {n[2], t, t1});
  relink(n[1], t, t1);
  relink(n[2], t, t2);
  doubtful_ = {{t, 0}, {t1, 0}, {t2, 0}};
}

SquareTriangulation::Quadrangle SquareTriangulation::quadrangle(Corner opposite) const {
  const std::uint32_t t = opposite.t, k = opposite.k, u = triangles_[t].n[k];
  const std::uint32_t j = back_from(u, t);
  const auto& [v, n] = triangles_[t];
  const auto& [w, m] = triangles_[u];
  return {t,
          u,
          v[k],
          v[(k + 1) % 3],
          v[(k + 2) % 3],
          w[j],
          n[(k + 1) % 3],
          n[(k + 2) % 3],
          m[(j + 1) % 3],
          m[(j + 2) % 3]};
}

void SquareTriangulation::split_side(Corner opposite, std::uint32_t p) {
  const auto [t, u, a, b, c, d, n_ca, n_ab, m_bd, m_dc] = quadrangle(opposite);
  const auto t1 = static_cast<std::uint32_t>(triangles_.size()), u1 = t1 + 1;
  triangles_.resize(triangles_.size() + 2);
  set(t, {p, a, b}, {n_ab, u1, t1});
  set(t1, {p, c, a}, {n_ca, t, u});
  set(u, {p, d, c}, {m_dc, t1, u1});
  set(u1, {p, b, d}, {m_bd, u, t});
  relink(n_ca, t, t1);
  relink(m_bd, u, u1);
  doubtful_ = {{t, 0}, {t1, 0}, {u, 0}, {u1, 0}};
}

/// Lawson's flips about p. Only those that are certain are made, so they come to an end.
void SquareTriangulation::make_delaunay(std::uint32_t p) {
  while (!doubtful_.empty()) {
    const Corner at = doubtful_.back();
    doubtful_.pop_back();
    const std::uint32_t u = triangles_[at.t].n[at.k];
    if (u == kNoTriangle) continue;
    const auto& v = triangles_[at.t].v;
    const std::uint32_t d = triangles_[u].v[back_from(u, at.t)];
    if (!is_inside_circle(points_[v[0]], points_[v[1]], points_[v[2]], points_[d])) continue;
    flip(at);
    doubtful_.push_back({at.t, corner_of(at.t, p)});
    doubtful_.push_back({u, corner_of(u, p)});
  }
}

/// Turns the side opposite to the corner: a, b, c and d, c, b become a, b, d and a, d, c.
void SquareTriangulation::flip(Corner opposite) {
  const auto [t, u, a, b, c, d, n_ca, n_ab, m_bd, m_dc] = quadrangle(opposite);
  set(t, {a, b, d}, {m_bd, u, n_ab});
  set(u, {a, d, c}, {m_dc, n_ca, t});
  relink(m_bd, u, t);
  relink(n_ca, t, u);
}

/// Of three points on one line: whether c lies on the same side of a as b.
bool SquareTriangulation::lies_ahead(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
  const Vec2 &p = points_[a], &q = points_[b], &r = points_[c];
  return (q.x > p.x) == (r.x > p.x) && (q.x < p.x) == (r.x < p.x) &&  //
         (q.y > p.y) == (r.y > p.y) && (q.y < p.y) == (r.y < p.y);
}

std::optional<std::vector<std::uint32_t>> SquareTriangulation::insert_segment(std::uint32_t a,
                                                                              std::uint32_t b) {
  std::vector<std::uint32_t> passed;
  a += kFrame, b += kFrame;
  while (a != b) {
    const std::optional<std::uint32_t> next = advance(a, b);
    if (!next) return std::nullopt;
    fixed_[side_key(a, *next)] = true;
    a = *next;
    if (a != b) passed.push_back(a - kFrame);
  }
  return passed;
}

/// Makes a side of the segment's piece from a to the first point on it, which is returned. Nothing where that
/// crosses a fixed side, or where products underflow, so that no sign can be trusted.
std::optional<std::uint32_t> SquareTriangulation::advance(std::uint32_t a, std::uint32_t b) {
  const std::uint32_t first = at_[a];
  std::uint32_t t = first;
  do {
    const std::uint32_t k = corner_of(t, a);
    const std::uint32_t r = triangles_[t].v[(k + 1) % 3], l = triangles_[t].v[(k + 2) % 3];
    const int of_r = turn(a, b, r);
    if (of_r == 0 && lies_ahead(a, b, r)) return r;
    if (of_r < 0 && turn(a, b, l) > 0) {
      std::deque<Side> crossed;
      const std::optional<std::uint32_t> end = collect_crossed({t, k}, b, crossed);
      if (!end || !turn_crossed(a, *end, crossed)) return std::nullopt;
      return end;
    }
    t = triangles_[t].n[(k + 1) % 3];
  } while (t != first);
  return std::nullopt;
}

/// The sides that the segment from the corner to b crosses, as far as the first point on it.
std::optional<std::uint32_t> SquareTriangulation::collect_crossed(Corner at, std::uint32_t b,
                                                                  std::deque<Side>& crossed) const {
  const std::uint32_t a = triangles_[at.t].v[at.k];
  for (;;) {
    const auto& v = triangles_[at.t].v;
    const std::uint32_t r = v[(at.k + 1) % 3], l = v[(at.k + 2) % 3];
    if (fixed_.contains(side_key(r, l))) return std::nullopt;
    crossed.emplace_back(r, l);
    const std::uint32_t u = triangles_[at.t].n[at.k], j = back_from(u, at.t);
    const std::uint32_t d = triangles_[u].v[j];
    const int side = turn(a, b, d);
    if (side == 0) return d;
    // In u the corners are d, l, r: the segment leaves it between d and the one on the other side.
    at = {u, side > 0 ? (j + 1) % 3 : (j + 2) % 3};
  }
}

SquareTriangulation::Corner SquareTriangulation::opposite_of(const Side& side) const {
  for (std::uint32_t t = at_[side.first];;) {
    const std::uint32_t k = corner_of(t, side.first);
    if (triangles_[t].v[(k + 1) % 3] == side.second) return {t, (k + 2) % 3};
    t = triangles_[t].n[(k + 1) % 3];
  }
}

/// Turns the crossed sides, each where it can be turned, until none crosses the segment from a to b. The
/// limit is far beyond what is needed.
bool SquareTriangulation::turn_crossed(std::uint32_t a, std::uint32_t b, std::deque<Side>& crossed) {
  for (std::size_t left = 4 * crossed.size() * crossed.size() + 16; !crossed.empty(); --left) {
    if (left == 0) return false;
    const Side side = crossed.front();
    crossed.pop_front();
    const Corner at = opposite_of(side);
    const std::uint32_t u = triangles_[at.t].n[at.k];
    const std::uint32_t p = triangles_[at.t].v[at.k], q = triangles_[u].v[back_from(u, at.t)];
    if (turn(p, q, side.first) * turn(p, q, side.second) >= 0) {
      crossed.push_back(side);
      continue;
    }
    flip(at);
    const bool ends_there = p == a || p == b || q == a || q == b;
    if (!ends_there && turn(a, b, p) * turn(a, b, q) < 0) crossed.emplace_back(p, q);
  }
  return true;
}

}  // namespace penumbra::detail
