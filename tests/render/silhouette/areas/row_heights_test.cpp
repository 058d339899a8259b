// Rows divide the height of D irregularly; counting them agrees with where they are.
#include "render/silhouette/areas/row_heights.h"

#include <gtest/gtest.h>

#include <complex>
#include <numbers>

namespace penumbra::detail {
namespace {

TEST(RowHeights, RowsLieInTheMiddleOfStrips) {
  for (const int family : {0, 1})
    for (const int rows : {4, 16, 48, 64, 192, 1024}) {
      const RowHeights heights(rows, family);
      EXPECT_EQ(heights.bound(0), 0.0);
      EXPECT_EQ(heights.bound(rows), 1.0);
      double least = 1.0, most = 0.0;
      for (int i = 0; i < rows; ++i) {
        const double low = heights.bound(i), high = heights.bound(i + 1), height = high - low;
        least = std::min(least, height * rows);
        most = std::max(most, height * rows);
        // A strip in which f bends is not halved exactly.
        EXPECT_NEAR(heights.row(i), 0.5 * (low + high), 0.1 * height) << rows << ' ' << i;
        EXPECT_EQ(heights.count().below(std::nextafter(heights.row(i), 0.0) - 1e-12), i);
        EXPECT_EQ(heights.count().below(heights.row(i) + 1e-12), i + 1);
      }
      EXPECT_GT(least, 0.75);
      EXPECT_LT(most, 1.35);
    }
}

TEST(RowHeights, WhatIsOutsideHasAllRowsOrNone) {
  const RowHeights heights(64, 0);
  EXPECT_EQ(heights.count().below(-1e-9), 0);
  EXPECT_EQ(heights.count().below(-2.0), 0);
  EXPECT_EQ(heights.count().below(1.0 + 1e-9), 64);
  EXPECT_EQ(heights.count().below(3.0), 64);
}

/// The mean of exp(2πi y/period) over the rows: 1 where the rows keep step with the period.
double in_step(const RowHeights& heights, double period) {
  std::complex<double> sum;
  for (int i = 0; i < heights.rows(); ++i)
    sum += std::polar(1.0, 2.0 * std::numbers::pi * heights.row(i) * heights.rows() / period);
  return std::abs(sum) / heights.rows();
}

TEST(RowHeights, NoPeriodKeepsStepWithBothFamilies) {
  const RowHeights one(48, 0), other(48, 1);
  double worst = 0.0, worst_of_both = 0.0;
  for (double period = 0.2; period < 1.5; period *= 1.0005) {
    const double a = in_step(one, period), b = in_step(other, period);
    worst = std::max({worst, a, b});
    worst_of_both = std::max(worst_of_both, std::min(a, b));
  }
  std::printf("in step: %.2f of rows, %.2f of both families\n", worst, worst_of_both);
  EXPECT_LT(worst, 0.75) << "1 for even distances";
  EXPECT_LT(worst_of_both, 0.6);
}

}  // namespace
}  // namespace penumbra::detail
