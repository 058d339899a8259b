#include "render/silhouette/areas/row_heights.h"

#include <array>

namespace penumbra::detail {
namespace {

// Accuracy. Held by the tests RowHeights and RegularPatterns.
/// By how much a wave changes the slope of f. With less, regular patterns keep step with rows over more of
/// them; with more, the few high strips err more than the others.
constexpr double kIrregularity = 0.1;
/// Periods of the two waves of each family, rows.
constexpr std::array<std::array<double, 2>, 2> kPeriods{{{7.31, 18.07}, {6.59, 16.73}}};

RowCount make_count(int rows, int family) {
  const auto [one, other] = kPeriods[family];
  RowCount f{1.0 * rows, kIrregularity * one, rows / one, kIrregularity * other, rows / other, 0.0, rows};
  // From f(0) = 0 to f(1) = rows.
  f.alpha += rows - f.value(1.0);
  return f;
}

}  // namespace

RowHeights::RowHeights(int rows, int family) : count_(make_count(rows, family)) {
  double share = 0.0;
  for (int i = 0; i <= 2 * rows; ++i) {
    // Slopes of f are near to α: each step leaves a fifth of the error.
    for (int step = 0; step < 24; ++step) share -= (count_.value(share) - 0.5 * i) / count_.alpha;
    at_.push_back(share);
  }
  at_.front() = 0.0, at_.back() = 1.0;
}

}  // namespace penumbra::detail
