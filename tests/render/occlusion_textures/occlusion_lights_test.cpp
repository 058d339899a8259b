// Occlusion textures under lights straight above, in and through casters.
#include <gtest/gtest.h>

#include <algorithm>
#include <initializer_list>

#include "tests/render/scale_support.h"

namespace penumbra {
namespace {

/// A box of side 1 on the floor at the origin.
testing::Frame frame_under(const LightShape& light) {
  Scene scene = testing::regression_scene("ground_2e1");
  scene.lights.front().shape = light;
  return testing::frame_of(scene, "occlusion-textures");
}

std::size_t pixels_not_in_range(const testing::Frame& frame) {
  return static_cast<std::size_t>(std::ranges::count_if(
      frame.visibility, [](float visibility) { return !(visibility >= 0.0f && visibility <= 1.0f); }));
}

// The top and the floor are parallel to the slices: their horizons meet no slice. Tiles at the box's outline have pixels on
// both: some of the slices before the floor are behind the top.
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

}  // namespace
}  // namespace penumbra
