// Solids: what moves a surface on grid edges to the safe side.
#pragma once

#include <vector>

#include "volumes/solids/grid_surface.h"

namespace penumbra::detail {

/// Pulls crossed edges, and grid points to the other side. Refers to its arguments.
class Carver {
 public:
  Carver(SolidGrid& grid, CrossedEdges& edges, bool inward) : grid_(grid), edges_(edges), inward_(inward) {}

  /// The corners of a triangle that are set in `which`, as bits. Where they are grid points of a cap, those
  /// change sides.
  void move(const GridSurface& surface, const IndexedTriangle& t, unsigned which) {
    const std::size_t edge_count = edges_.all().size();
    for (int k = 0; k < 3; ++k) {
      if (!(which >> k & 1)) continue;
      if (t[k] < edge_count)
        pull(t[k]);
      else
        flip(surface.cap_points[t[k] - edge_count]);
    }
  }
  /// Edges are moved once until this is called; then grid points change sides.
  void finish() {
    for (const std::uint32_t v : flipped_) grid_.set_inside(v, !inward_);
    if (!flipped_.empty()) edges_.update(inward_ ? 1.0 - kStart : kStart, kStart / 2.0);
    flipped_.clear();
  }

 private:
  /// The first pull, of an edge, and how many times as far each next one is.
  static constexpr double kFirstPull = 1.0 / 200, kPullGrowth = 1.6;
  /// Where an edge begins that is crossed since a grid point changed sides: so far from that point.
  static constexpr double kStart = 1.0 / 16;

  void pull(std::uint32_t number) {
    CrossedEdge& e = edges_.all()[number];
    if (e.moved || e.in_wall) return;  // pulled already, or fixed
    e.moved = e.doubtful = true;
    e.pull = e.pull > 0.0 ? kPullGrowth * e.pull : kFirstPull;
    e.at += inward_ ? -e.pull : e.pull;
    if (e.at <= 0.0) flip(edges_.inner_end(e));
    if (e.at >= 1.0) flip(edges_.outer_end(e));
  }
  void flip(std::uint32_t vertex) { flipped_.push_back(vertex); }

  SolidGrid& grid_;
  CrossedEdges& edges_;
  bool inward_;
  std::vector<std::uint32_t> flipped_;
};

}  // namespace penumbra::detail
