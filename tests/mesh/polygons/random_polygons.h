// Random simple polygons with holes, of known area: cells of a bent grid, and a walk round them.
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "mesh/polygons/orientation.h"

namespace penumbra::test {

struct RandomPolygon {
  /// Counter-clockwise. Where it winds round a hole it goes there and back along a bridge.
  std::vector<detail::Vec2> line;
  /// Twice the area of the cells: exact, since coordinates are whole numbers.
  double double_area = 0.0;
  bool has_bridges = false;
};

/// `slits`: the line also runs in and out along sides between cells. `bent`: the grid's points are moved at
/// random; otherwise many corners lie on one line.
RandomPolygon make_random_polygon(std::mt19937_64& random, bool slits, bool bent);

}  // namespace penumbra::test
