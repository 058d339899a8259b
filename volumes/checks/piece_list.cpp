#include "volumes/checks/piece_list.h"

#include <algorithm>
#include <numeric>

#include "penumbra/volumes/predicates/predicates.h"

namespace penumbra::detail {

std::vector<std::vector<std::uint32_t>> connected_pieces(std::size_t vertex_count,
                                                         std::span<const IndexedTriangle> triangles) {
  constexpr std::uint32_t kUnset = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> parent(vertex_count);
  std::iota(parent.begin(), parent.end(), 0u);
  const auto root = [&](std::uint32_t v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  for (const IndexedTriangle& t : triangles) {
    parent[root(t[1])] = root(t[0]);
    parent[root(t[2])] = root(t[0]);
  }
  std::vector<std::uint32_t> number(vertex_count, kUnset);
  std::vector<std::vector<std::uint32_t>> pieces;
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    std::uint32_t& n = number[root(triangles[i][0])];
    if (n == kUnset) {
      n = static_cast<std::uint32_t>(pieces.size());
      pieces.emplace_back();
    }
    pieces[n].push_back(i);
  }
  return pieces;
}

PieceList::PieceList(const ShadowMesh& mesh) : mesh_(mesh) {
  for (std::vector<std::uint32_t>& triangles : connected_pieces(mesh.positions.size(), mesh.triangles)) {
    Piece piece{std::move(triangles), {}};
    for (const std::uint32_t i : piece.triangles) {
      for (const std::uint32_t v : mesh.triangles[i]) {
        piece.box.add(mesh.positions[v]);
        piece.middle += mesh.positions[v] / (3.0 * static_cast<double>(piece.triangles.size()));
      }
    }
    pieces_.push_back(std::move(piece));
  }
}

bool PieceList::is_beyond(const Vec3& x, std::uint32_t triangle) const {
  const IndexedTriangle& t = mesh_.triangles[triangle];
  return orient3d(mesh_.positions[t[0]], mesh_.positions[t[1]], mesh_.positions[t[2]], x) == Sign::kPositive;
}

bool PieceList::contains(const Vec3& x) const {
  return std::any_of(pieces_.begin(), pieces_.end(), [&](const Piece& piece) {
    for (int k = 0; k < 3; ++k) {
      if (x[k] < piece.box.low[k] || x[k] > piece.box.high[k]) return false;
    }
    return std::none_of(piece.triangles.begin(), piece.triangles.end(),
                        [&](std::uint32_t i) { return is_beyond(x, i); });
  });
}

Vec3 PieceList::point_inside(std::mt19937_64& random) const {
  constexpr int kCorners = 4;       // averaged
  constexpr double kInward = 1e-6;  // weight of the piece's middle: far above rounding
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const auto pick = [&](std::size_t count) {
    return std::min(count - 1, static_cast<std::size_t>(unit(random) * static_cast<double>(count)));
  };
  const Piece& piece = pieces_[pick(pieces_.size())];
  double weights = kInward;
  Vec3 sum = weights * piece.middle;
  for (int i = 0; i < kCorners; ++i) {
    const IndexedTriangle& t = mesh_.triangles[piece.triangles[pick(piece.triangles.size())]];
    const double u = unit(random), weight = u * u * u;  // of several corners one counts most
    sum += weight * mesh_.positions[t[pick(3)]];
    weights += weight;
  }
  return sum / weights;
}

}  // namespace penumbra::detail
