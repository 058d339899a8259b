#include "tests/mesh/polygons/random_polygons.h"

#include <algorithm>
#include <array>

namespace penumbra::test {
namespace {

using detail::Vec2;

constexpr int kSize = 8, kPitch = 100, kBend = 24;
constexpr std::array<std::array<int, 2>, 4> kAround = {{{0, -1}, {1, 0}, {0, 1}, {-1, 0}}};

/// Cells that grew from one, and the sides that the growth crossed: a tree. Some cells stay free.
struct Cells {
  bool taken[kSize][kSize] = {};
  bool free[kSize][kSize] = {};
  bool open[kSize][kSize][4] = {};  ///< side k: below, right, above, left
};

Cells grow(std::mt19937_64& random) {
  Cells cells;
  std::vector<std::array<int, 2>> list = {{kSize / 2, kSize / 2}};
  cells.taken[kSize / 2][kSize / 2] = true;
  for (int i = 0; i < 8; ++i) cells.free[random() % kSize][random() % kSize] = true;
  const std::size_t wanted = 24 + random() % 38;
  for (int tries = 0; tries < 4000 && list.size() < wanted; ++tries) {
    const auto [x, y] = list[random() % list.size()];
    const std::size_t k = random() % 4;
    const int u = x + kAround[k][0], v = y + kAround[k][1];
    if (u < 0 || v < 0 || u >= kSize || v >= kSize || cells.taken[u][v] || cells.free[u][v]) continue;
    cells.taken[u][v] = cells.open[x][y][k] = cells.open[u][v][(k + 2) % 4] = true;
    list.push_back({u, v});
  }
  return cells;
}

/// Round the tree with the hand on its walls. Side k of a cell begins at its corner k.
std::vector<std::array<int, 2>> walk_round(const Cells& cells) {
  const auto corner = [](int x, int y, std::size_t k) {
    return std::array{x + (k == 1 || k == 2), y + (k == 2 || k == 3)};
  };
  int x = kSize / 2, y = kSize / 2;
  std::size_t k = 0;
  const auto to_wall = [&] {
    while (cells.open[x][y][k]) {
      x += kAround[k][0], y += kAround[k][1];
      k = (k + 3) % 4;
    }
  };
  to_wall();
  const std::array<int, 3> start = {x, y, static_cast<int>(k)};
  std::vector<std::array<int, 2>> line;
  do {
    line.push_back(corner(x, y, k));
    k = (k + 1) % 4;
    to_wall();
  } while (start != std::array<int, 3>{x, y, static_cast<int>(k)});
  return line;
}

/// Takes away every there-and-back.
void remove_slits(std::vector<std::array<int, 2>>& line) {
  for (std::size_t i = 0; i < line.size() && line.size() > 2;) {
    const std::size_t n = line.size(), before = (i + n - 1) % n, after = (i + 1) % n;
    if (line[before] != line[after]) {
      ++i;
      continue;
    }
    line.erase(line.begin() + static_cast<std::ptrdiff_t>(std::max(i, after)));
    line.erase(line.begin() + static_cast<std::ptrdiff_t>(std::min(i, after)));
    i = 0;
  }
}

}  // namespace

RandomPolygon make_random_polygon(std::mt19937_64& random, bool slits, bool bent) {
  Vec2 point[kSize + 1][kSize + 1];
  for (int x = 0; x <= kSize; ++x)
    for (int y = 0; y <= kSize; ++y) {
      const auto bend = [&] { return bent ? static_cast<int>(random() % (2 * kBend + 1)) - kBend : 0; };
      const int u = bend(), v = bend();
      point[x][y] = {kPitch * x + u, kPitch * y + v};
    }
  const Cells cells = grow(random);
  std::vector<std::array<int, 2>> line = walk_round(cells);
  if (!slits) remove_slits(line);
  RandomPolygon polygon;
  for (int x = 0; x < kSize; ++x)
    for (int y = 0; y < kSize; ++y) {
      if (!cells.taken[x][y]) continue;
      const Vec2 p = point[x + 1][y + 1] - point[x][y], q = point[x][y + 1] - point[x + 1][y];
      polygon.double_area += p.x * q.y - p.y * q.x;
    }
  for (const auto& [x, y] : line) polygon.line.push_back(point[x][y]);
  for (std::size_t i = 0; i < line.size(); ++i) {
    for (std::size_t j = 0; j < line.size(); ++j)
      polygon.has_bridges |= line[i] == line[(j + 1) % line.size()] && line[j] == line[(i + 1) % line.size()];
  }
  std::ranges::rotate(polygon.line,
                      polygon.line.begin() + static_cast<std::ptrdiff_t>(random() % line.size()));
  return polygon;
}

}  // namespace penumbra::test
