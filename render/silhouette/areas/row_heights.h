// Silhouette method, step area: where a family of rows lies.
//
// Strips divide the height of D; a row is the middle line of a strip, but for the few in which f bends, see
// below. What passes through a strip from below to above is measured exactly by its middle line. Heights of
// strips are irregular, 1/1.2 to 1/.8 of their mean, so that no regular pattern keeps step with the rows:
// with s the share of D's height, from its lowest point up, strip i lies where
//   f(s) = α s + a T(k s) + b T(l s) + c,   T(x) the distance of x from the nearest whole number,
// is i to i + 1. The periods of the two waves are some 7 and 18 rows and share no multiple; slopes of f are
// (1 ± .1 ± .1) α.
#pragma once

#include <cmath>
#include <vector>

#include "render/support/vector_clones.h"

namespace penumbra::detail {

/// f.
struct RowCount {
  double alpha, a, k, b, l, c;
  int rows;

  PENUMBRA_INLINE double value(double share) const {
    return alpha * share + a * from_whole(k * share) + b * from_whole(l * share) + c;
  }
  /// The number of rows below a share, which is the number of the first row above. Rounded alike for segments
  /// and events, so that depth complexities stay whole.
  PENUMBRA_INLINE int below(double share) const {
    const int count = static_cast<int>(value(share) + 0.5);
    return count < 0 ? 0 : count > rows ? rows : count;
  }
  /// T.
  static PENUMBRA_INLINE double from_whole(double x) {
    return std::abs(x - static_cast<double>(static_cast<int>(x + 0.5)));
  }
};

/// Rows and the bounds of their strips, as shares of D's height.
class RowHeights {
 public:
  /// `family` says which waves, 0 or 1. Cost O(rows).
  RowHeights(int rows, int family);

  const RowCount& count() const { return count_; }
  int rows() const { return count_.rows; }
  double row(int i) const { return at_[2 * i + 1]; }
  /// Strip i lies between bound(i) and bound(i + 1).
  double bound(int i) const { return at_[2 * i]; }

 private:
  RowCount count_;
  /// Where f is a half of 0, 1, 2 …
  std::vector<double> at_;
};

}  // namespace penumbra::detail
