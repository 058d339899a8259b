// Occlusion textures at any scale and under lights at any distance.
#include <gtest/gtest.h>

#include "tests/render/scale_support.h"

namespace penumbra {
namespace {

// Sheets by the texels' coverage: else the error depends on where in a texel an edge happens to lie, .02 to
// .09.
TEST(OcclusionScale, KeepsItsOwnError) {
  testing::expect_own_error("occlusion-textures", {{"coverage", std::string("area")}});
}

TEST(OcclusionScale, ScenesAreTheSameAtAnyScaleAndPlace) {
  testing::expect_same_at_any_scale("occlusion-textures", testing::data_scene("boxes-medium"), 0.01);
  testing::expect_same_at_any_scale("occlusion-textures", testing::regression_scene("sun_distant"), 0.01);
}

TEST(OcclusionScale, FarDisksConvergeToTheDistantLight) {
  testing::expect_suns_to_converge("occlusion-textures", 0.02, 0.005);
}

// The plane of a box's side runs through the sun's center: the receiver's horizon halves the sun, and the box
// itself must not hide the rest.
TEST(OcclusionTextures, ASidePlaneSeesItsHalfOfTheSun) {
  const testing::Frame frame =
      testing::frame_of(testing::regression_scene("sun_distant"), "occlusion-textures");
  std::size_t pixels = 0;
  double sum = 0.0;
  for (std::size_t i = 0; i < frame.visibility.size(); ++i) {
    if (!frame.surface.hit(i) || frame.surface.object[i] != 1 || frame.surface.normal[i].z < 0.9) continue;
    ++pixels;
    sum += frame.visibility[i];
  }
  ASSERT_GT(pixels, 100u);
  EXPECT_NEAR(sum / static_cast<double>(pixels), 0.5, 0.02);
}

}  // namespace
}  // namespace penumbra
