// Accurate rung, step 5 of 5: levels over the disk, and the area of the lowest.
//
// Rows of scanlines cross the segments; between crossings the level L (faces that hide, relative to D's
// lowest point) is constant, so each row is divided into exact intervals. That gives an area A_k for every
// level k, good to the rows' spacing. The exact integral of L (silhouette_integrate.h) then corrects the area
// of the lowest level as a control variate: with p the share of the lowest level in D,
//   area = |D| p + c (∫ L - |D| mean L),   c = cov(lowest?, L) / var L   under the areas A_k.
// Where two levels occur c is -1 over their difference and the result is exact, whatever the rows; where more
// do, rows only have to measure the overlap.
//
// The lowest level is what nothing hides, or else everything is hidden: one ray tells. It aims at the middle
// of the longest interval of that level, with a second try on another row, since a point may happen to lie
// near an edge that runs along the row.
#pragma once

#include <array>

#include "render/silhouette_integrate.h"

namespace penumbra::detail {

struct Fused {
  double area = 0.0;               ///< of the lowest level, 0 to |D|
  int levels = 1;                  ///< how many were met
  std::array<glm::dvec2, 2> aims;  ///< two points of the lowest level
};

/// Scanlines for one receiver after the other, with memory kept between them.
class Scanlines {
 public:
  Fused fuse(const Cut& cut, const DiskPart& part, int rows);

 private:
  struct Crossing {
    double x;
    int change;
  };
  struct Interval {
    double length = 0.0;
    glm::dvec2 middle{0.0};
  };
  struct Level {
    double area = 0.0;
    std::array<Interval, 2> longest;  ///< on even and on odd rows
  };
  void cross_rows(const Cut& cut, const DiskPart& part, int rows);
  void sweep_row(int row, double y, const DiskPart& part);
  void add_interval(int row, double y, double from, double to, int level);

  std::vector<int> starts_;       ///< first crossing of each row
  std::vector<int> left_levels_;  ///< at the left end of each row
  std::vector<Crossing> crossings_;
  std::vector<Level> levels_;
  int lowest_ = 0, highest_ = 0;
};

}  // namespace penumbra::detail
