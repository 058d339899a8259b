#include "volumes/solids/grid_surface.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <glm/geometric.hpp>
#include <unordered_map>

namespace penumbra::detail {
namespace {

/// The tetrahedra of a cube by the bits of their corners, positively oriented.
constexpr unsigned kTetrahedra[6][4] = {{0, 1, 3, 7}, {0, 2, 6, 7}, {0, 4, 5, 7},
                                        {0, 3, 2, 7}, {0, 6, 4, 7}, {0, 5, 1, 7}};

/// Of names: triangles of grid points in the grid's boundary follow the tetrahedra.
constexpr std::uint64_t kFirstCap = std::uint64_t{1} << 59;

class Builder {
 public:
  Builder(const CrossedEdges& edges, Diagonals diagonals)
      : edges_(edges), grid_(edges.grid()), diagonals_(diagonals) {}

  GridSurface run() {
    const std::vector<CrossedEdge>& crossed = edges_.all();
    out_.positions.resize(crossed.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, crossed.size(), 1024), [&](const auto& range) {
      for (std::size_t i = range.begin(); i < range.end(); ++i)
        out_.positions[i] = edges_.position(crossed[i]);
    });
    const std::vector<std::uint32_t>& blocks = edges_.active_blocks();
    std::vector<Part> parts(blocks.size());
    tbb::parallel_for(std::size_t{0}, blocks.size(), [&](std::size_t i) {
      for (std::uint32_t v = blocks[i] * 64; v < (blocks[i] + 1) * 64; ++v) add_cube(v, parts[i]);
    });
    for (const Part& part : parts) {
      out_.triangles.insert(out_.triangles.end(), part.triangles.begin(), part.triangles.end());
      out_.fourth.insert(out_.fourth.end(), part.fourth.begin(), part.fourth.end());
      out_.names.insert(out_.names.end(), part.names.begin(), part.names.end());
    }
    out_.inner_triangles = out_.triangles.size();
    add_caps();
    return std::move(out_);
  }

 private:
  struct Part {
    std::vector<IndexedTriangle> triangles;
    std::vector<std::uint32_t> fourth;
    std::vector<std::uint64_t> names;
    void add(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t other, std::uint64_t name) {
      triangles.push_back({a, b, c});
      fourth.push_back(other);
      names.push_back(name);
    }
  };

  void add_cube(std::uint32_t v, Part& out) const {
    std::array<std::uint32_t, 8> corners;
    unsigned inside = 0;
    for (unsigned b = 0; b < 8; ++b) {
      corners[b] = grid_.beyond(v, b);
      if (corners[b] == SolidGrid::kNone) return;
      inside |= grid_.is_inside(corners[b]) ? 1u << b : 0u;
    }
    if (inside == 0 || inside == 255) return;
    const auto on = [&](unsigned p, unsigned q) { return edge(corners[p & q], p ^ q); };
    std::uint64_t number = std::uint64_t{6} * v;
    for (const auto& t : kTetrahedra) add_tetrahedron(t, number++, inside, on, out);
  }

  template <class On>
  void add_tetrahedron(const unsigned (&t)[4], std::uint64_t number, unsigned inside, const On& on,
                       Part& out) const {
    unsigned mask = 0;
    for (unsigned k = 0; k < 4; ++k) mask |= (inside >> t[k] & 1) << k;
    const int count = std::popcount(mask);
    if (count == 0 || count == 4) return;
    const std::uint64_t name = (number << 4 | mask) << 2;
    // Even permutations that bring the odd one, or the two inside, to the front.
    constexpr unsigned kFront[4][4] = {{0, 1, 2, 3}, {1, 0, 3, 2}, {2, 3, 0, 1}, {3, 2, 1, 0}};
    constexpr unsigned kPairs[6][4] = {{0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2},
                                       {1, 2, 0, 3}, {1, 3, 2, 0}, {2, 3, 0, 1}};
    if (count != 2) {
      const unsigned odd = static_cast<unsigned>(std::countr_zero(count == 1 ? mask : ~mask & 15u));
      const auto& p = kFront[odd];
      const std::uint32_t x = on(t[p[0]], t[p[1]]), y = on(t[p[0]], t[p[2]]), z = on(t[p[0]], t[p[3]]);
      if (count == 1)
        out.add(x, y, z, x, name);
      else
        out.add(x, z, y, x, name);
      return;
    }
    for (const auto& p : kPairs) {
      if (mask != (1u << p[0] | 1u << p[1])) continue;
      const std::uint32_t ac = on(t[p[0]], t[p[2]]), ad = on(t[p[0]], t[p[3]]), bd = on(t[p[1]], t[p[3]]),
                          bc = on(t[p[1]], t[p[2]]);
      const auto& at = out_.positions;
      const Vec3 normal = glm::cross(at[ad] - at[ac], at[bd] - at[ac]);
      const bool is_ridge = glm::dot(normal, at[bc] - at[ac]) < 0.0;  // the side between ac and bd
      if (is_ridge == (diagonals_ == Diagonals::kLarger)) {
        out.add(ac, ad, bd, bc, name);
        out.add(ac, bd, bc, ad, name + 1);
      } else {
        out.add(ac, ad, bc, bd, name + 2);
        out.add(ad, bd, bc, ac, name + 3);
      }
    }
  }

  /// Of the edge between two of a cube's corners, one of which lies below the other.
  std::uint32_t edge(std::uint32_t from, unsigned bits) const { return edges_.number(from, bits); }

  void add_caps() {
    const GridIndex& n = grid_.counts();
    std::uint64_t squares = 0;  // so far
    for (int axis = 0; axis < 3; ++axis) {
      const int u = (axis + 1) % 3, v = (axis + 2) % 3;
      const unsigned du = 1u << u, dv = 1u << v;
      for (const bool high : {false, true}) {
        const auto corner = [&](std::int32_t i, std::int32_t j) {
          GridIndex at;
          at[axis] = high ? n[axis] - 1 : 0;
          at[u] = i;
          at[v] = j;
          return grid_.vertex(at);
        };
        std::vector<std::vector<std::int32_t>> some(static_cast<std::size_t>(n[v] - 1));
        tbb::parallel_for(0, n[v] - 1, [&](std::int32_t j) {
          const auto is_inside = [&](std::int32_t i) {
            return grid_.is_inside(corner(i, j)) || grid_.is_inside(corner(i, j + 1));
          };
          bool before = is_inside(0);
          for (std::int32_t i = 0; i + 1 < n[u]; ++i) {
            const bool next = is_inside(i + 1);
            if (before || next) some[static_cast<std::size_t>(j)].push_back(i);
            before = next;
          }
        });
        for (const std::vector<std::int32_t>& row : some) {
          const auto j = static_cast<std::int32_t>(&row - some.data());
          for (const std::int32_t i : row)
            add_square(corner(i, j), du, dv, high, squares + static_cast<std::uint64_t>(i));
          squares += static_cast<std::uint64_t>(n[u] - 1);
        }
      }
    }
  }

  void add_square(std::uint32_t corner, unsigned u, unsigned v, bool turned, std::uint64_t number) {
    const unsigned a[2][3] = {{0, u, u | v}, {0, u | v, v}};
    std::uint64_t name = kFirstCap + 2 * number;
    for (const auto& t : a)
      add_cap(corner,
              turned ? std::array<unsigned, 3>{t[0], t[1], t[2]} : std::array<unsigned, 3>{t[0], t[2], t[1]},
              name++);
  }

  /// The part of a triangle of grid points that is inside.
  void add_cap(std::uint32_t corner, const std::array<unsigned, 3>& t, std::uint64_t number) {
    std::array<std::uint32_t, 4> polygon;
    std::size_t count = 0;
    std::uint64_t mask = 0;
    for (int k = 0; k < 3; ++k) {
      const unsigned p = t[k], q = t[(k + 1) % 3];
      const std::uint32_t here = grid_.beyond(corner, p), next = grid_.beyond(corner, q);
      if (grid_.is_inside(here)) {
        polygon[count++] = cap_point(here);
        mask |= std::uint64_t{1} << k;
      }
      if (grid_.is_inside(here) != grid_.is_inside(next))
        polygon[count++] = edge(grid_.beyond(corner, p & q), p ^ q);
    }
    for (std::size_t k = 2; k < count; ++k) {
      out_.triangles.push_back({polygon[0], polygon[k - 1], polygon[k]});
      out_.names.push_back((number << 3 | mask) << 1 | (k - 2));
    }
  }

  std::uint32_t cap_point(std::uint32_t vertex) {
    const auto [at, is_new] =
        cap_points_.try_emplace(vertex, static_cast<std::uint32_t>(out_.positions.size()));
    if (is_new) {
      out_.positions.push_back(grid_.point(vertex));
      out_.cap_points.push_back(vertex);
    }
    return at->second;
  }

  const CrossedEdges& edges_;
  const SolidGrid& grid_;
  Diagonals diagonals_;
  std::unordered_map<std::uint32_t, std::uint32_t> cap_points_;
  GridSurface out_;
};

}  // namespace

/// Those that differ from one of the blocks above, or are not all on one side.
void CrossedEdges::find_active_blocks() {
  const auto blocks = static_cast<std::uint32_t>(grid_.block_count());
  enum : char { kOutside, kInside, kMixed };
  std::vector<char> state(blocks), active(blocks, 0);
  tbb::parallel_for(0u, blocks, [&](std::uint32_t b) {
    int inside = 0;
    for (std::uint32_t v = b * 64; v < (b + 1) * 64; ++v) inside += grid_.is_inside(v) ? 1 : 0;
    state[b] = inside == 0 ? kOutside : inside == 64 ? kInside : kMixed;
  });
  tbb::parallel_for(0u, blocks, [&](std::uint32_t b) {
    active[b] = state[b] == kMixed ? 1 : 0;
    for (unsigned bits = 1; bits < 8 && !active[b]; ++bits) {
      const std::uint32_t other = grid_.block_beyond(b, bits);
      active[b] = other != SolidGrid::kNone && state[other] != state[b] ? 1 : 0;
    }
  });
  active_.clear();
  for (std::uint32_t b = 0; b < blocks; ++b)
    if (active[b]) active_.push_back(b);
}

void CrossedEdges::update(double at, double pull) {
  find_active_blocks();
  std::vector<std::uint32_t> count(active_.size() + 1, 0);
  crossed_.resize(grid_.size());
  first_.resize(grid_.size());
  tbb::parallel_for(std::size_t{0}, active_.size(), [&](std::size_t i) {
    std::uint32_t sum = 0;
    for (std::uint32_t v = active_[i] * 64; v < (active_[i] + 1) * 64; ++v) {
      std::uint8_t mask = 0;
      for (unsigned bits = 1; bits < 8; ++bits) {
        const std::uint32_t other = grid_.beyond(v, bits);
        if (other != SolidGrid::kNone && grid_.is_inside(v) != grid_.is_inside(other))
          mask = static_cast<std::uint8_t>(mask | 1u << (bits - 1));
      }
      crossed_[v] = mask;
      sum += static_cast<std::uint32_t>(std::popcount(mask));
    }
    count[i + 1] = sum;
  });
  for (std::size_t i = 1; i < count.size(); ++i) count[i] += count[i - 1];
  const std::vector<CrossedEdge> old = std::move(edges_);
  edges_ = std::vector<CrossedEdge>(count.back());
  tbb::parallel_for(std::size_t{0}, active_.size(), [&](std::size_t i) {
    std::uint32_t next = count[i];
    if (count[i] == count[i + 1]) return;
    auto known = std::ranges::lower_bound(old, active_[i] * 64, {}, &CrossedEdge::from);
    for (std::uint32_t v = active_[i] * 64; v < (active_[i] + 1) * 64; ++v) {
      first_[v] = next;
      for (unsigned bits = 1; bits < 8; ++bits) {
        if (!(crossed_[v] >> (bits - 1) & 1)) continue;
        CrossedEdge e{.from = v,
                      .bits = static_cast<std::uint8_t>(bits),
                      .from_is_inside = grid_.is_inside(v),
                      .at = at,
                      .pull = pull};
        if (wall_) put_into_wall(e);
        while (known != old.end() && std::pair(known->from, known->bits) < std::pair(e.from, e.bits)) ++known;
        if (known != old.end() && known->from == e.from && known->bits == e.bits &&
            known->from_is_inside == e.from_is_inside)
          e = *known;
        edges_[next++] = e;
      }
    }
  });
}

/// A little in front of it, so that what is told of points in front holds.
void CrossedEdges::put_into_wall(CrossedEdge& e) const {
  constexpr double kInFront = 1e-6;
  const double inner = glm::dot(wall_->normal, grid_.point(inner_end(e))) - wall_->offset,
               outer = glm::dot(wall_->normal, grid_.point(outer_end(e))) - wall_->offset;
  if (!(inner > 0.0) || outer > 0.0) return;
  e.in_wall = true;
  e.at = (1.0 - kInFront) * inner / (inner - outer);
}

std::uint32_t CrossedEdges::number(std::uint32_t from, unsigned bits) const {
  const unsigned below = crossed_[from] & ((1u << (bits - 1)) - 1u);
  return first_[from] + static_cast<std::uint32_t>(std::popcount(below));
}

Vec3 CrossedEdges::position(const CrossedEdge& e) const {
  const Vec3 inner = grid_.point(inner_end(e)), outer = grid_.point(outer_end(e));
  return inner + e.at * (outer - inner);
}

GridSurface grid_surface(const CrossedEdges& edges, Diagonals diagonals) {
  return Builder(edges, diagonals).run();
}

}  // namespace penumbra::detail
