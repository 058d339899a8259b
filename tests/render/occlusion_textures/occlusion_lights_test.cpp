// Occlusion textures under lights straight above, in and through casters.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <initializer_list>

#include "tests/render/scale_support.h"

namespace penumbra {
namespace {

/// A box of side 1 on the floor at the origin.
testing::Frame frame_under(const LightShape& light, const OptionValues& options = {}) {
  Scene scene = testing::regression_scene("ground_2e1");
  scene.lights.front().shape = light;
  return testing::frame_of(scene, "occlusion-textures", options);
}

std::size_t pixels_not_in_range(const testing::Frame& frame) {
  return static_cast<std::size_t>(std::ranges::count_if(
      frame.visibility, [](float visibility) { return !(visibility >= 0.0f && visibility <= 1.0f); }));
}

// The top and the floor are parallel to the slices: their horizons meet no slice. Tiles at the box's outline
// have pixels on both: some of the slices before the floor are behind the top.
TEST(OcclusionTextures, ATopAlongTheSlicesSeesAllOfTheLight) {
  for (const LightShape& light : std::initializer_list<LightShape>{
           DistantLight{{0, -1, 0}, 2.0}, DiskLight{{0.1, 1.0 + 1e-9, 0}, {0, -1, 0}, 0.2},
           DiskLight{{0.1, 8.0, 0}, {0, -1, 0}, 0.2}}) {
    const testing::Frame frame = frame_under(light);
    EXPECT_EQ(pixels_not_in_range(frame), 0u);
    std::size_t top = 0, hidden = 0;
    for (std::size_t i = 0; i < frame.visibility.size(); ++i) {
      if (frame.surface.object[i] != 1 || frame.surface.normal[i].y < 0.9) continue;
      ++top;
      hidden += frame.visibility[i] != 1.0f;
    }
    EXPECT_GT(top, 300u);
    EXPECT_EQ(hidden, 0u);
  }
}

/// Root mean square of V over what is seen.
double rms(const testing::Frame& frame) {
  double squares = 0.0;
  std::size_t seen = 0;
  for (std::size_t i = 0; i < frame.visibility.size(); ++i) {
    if (!frame.surface.hit(i)) continue;
    squares += frame.visibility[i] * frame.visibility[i];
    ++seen;
  }
  return std::sqrt(squares / static_cast<double>(seen));
}

// Nothing outside sees the light, so V is its own error. Walls go on from slice to slice, and light leaks
// between: .389, and .067 to .100 with the fix, by where the slices end. The bounds are some quarter above.
TEST(OcclusionTextures, AClosedBoxAroundTheLightLeaksLittleWithTheThinFix) {
  const DiskLight inside{{0, 0.5, 0}, {0, -1, 0}, 0.2};
  const double plain = rms(frame_under(inside)),
               fixed = rms(frame_under(inside, {{"thin-fix", std::string("on")}}));
  std::printf("RMS of V outside: %.4f, with the thin fix %.4f\n", plain, fixed);
  EXPECT_LE(plain, 0.48);
  EXPECT_LE(fixed, 0.125);
}

}  // namespace
}  // namespace penumbra
