// What references from rays are worth, and hence `compare`.
#include <gtest/gtest.h>

#include "tests/render/error_support.h"

namespace penumbra {
namespace {

using testing::Pixels;
using testing::Values;

// Bounds: what stratified rays are known to reach.
TEST(Reference, NoiseIsThatOfStratifiedRays) {
  const Scene scene = testing::data_scene("cube-medium");
  const testing::View view(scene, 320, 240);
  const Pixels pixels = view.near_penumbra(testing::every_pixel(view.surface));
  const Values r1 = view.trace(pixels, 4096, 101), r2 = view.trace(pixels, 4096, 102);
  const ErrorFigures coarse = testing::penumbra_error(view.trace(pixels, 256, 1), r1, r2);
  const ErrorFigures fine = testing::penumbra_error(view.trace(pixels, 4096, 1), r1, r2);
  std::printf("%zu pixels: 256 samples %.5f, 4096 samples %.5f\n", coarse.pixels, coarse.rmse, fine.rmse);
  EXPECT_GT(coarse.pixels, 2'000u);
  EXPECT_GE(coarse.rmse, 0.0055);
  EXPECT_LE(coarse.rmse, 0.0067);
  EXPECT_GE(fine.rmse, 0.0007);
  EXPECT_LE(fine.rmse, 0.0009);
}

}  // namespace
}  // namespace penumbra
