// Entries that rays refute: what is asked, and what dropping them does for the picture.
#include <gtest/gtest.h>

#include "render/center_rays.h"
#include "render/d_buffer.h"
#include "tests/render/render_support.h"

namespace penumbra {
namespace {

using testing::at_pixels;
using testing::Pixels;
using testing::Values;
using testing::View;

constexpr glm::vec2 kNowhere(2.0f);

/// Receivers under a plate that hides the disk's half x < 0 from the middle one, all of it from the left one
/// and nothing from the right one.
struct HalfPlate {
  Scene scene = testing::scene_in_light_frame(1.0, {testing::rectangle(-20, 0, -20, 20, 2)});
  RayScene rays{scene, 0};
  SurfaceBuffer surface =
      testing::receivers({{-8, 0, 4}, {-0.2, 0, 4}, {0.2, 0, 4}, {8, 0, 4}}, Vec3(0, 0, -1), 4);
  CenterRays center{surface, rays};
};

TEST(EntryCheck, RaysSpeakAgainstPenumbraeWhereThereAreNone) {
  const HalfPlate under;
  const Values cuts = under.center.first_cut(under.scene.light);
  EXPECT_LT(cuts[0], 1.0f);
  EXPECT_LT(cuts[1], 1.0f);
  EXPECT_EQ(cuts[2], 1.0f);
  EXPECT_EQ(cuts[3], 1.0f);
  // For the light's frame x may be turned about the normal: ask on both sides.
  for (const glm::vec2 aim : {glm::vec2(0.6f, 0.0f), glm::vec2(-0.6f, 0.0f), glm::vec2(0.0f, 0.6f)}) {
    const std::vector<char> refuted =
        under.center.refuted(under.scene.light, std::vector<glm::vec2>(4, aim), cuts);
    EXPECT_EQ(refuted, (std::vector<char>{1, 0, 0, 1})) << aim.x << " " << aim.y;
  }
}

TEST(EntryCheck, NothingIsSaidWhereNothingIsAsked) {
  const HalfPlate under;
  const Values cuts = under.center.first_cut(under.scene.light);
  EXPECT_EQ(under.center.refuted(under.scene.light, std::vector<glm::vec2>(4, kNowhere), cuts),
            std::vector<char>(4, 0));
}

TEST(EntryCheck, LessensTheError) {
  const auto context = gl::make_context(gl::Backend::kOsMesa);
  for (const char* name : {"bunny-small", "knot1-medium", "armadillo-medium", "foliage-medium"}) {
    const Scene scene = testing::data_scene(name);
    const View view(scene, 240, 180);
    DBuffer buffer(*context, scene, view.rays);
    buffer.set_surface(view.surface);
    const Pixels near = view.near_penumbra(testing::every_pixel(view.surface));
    const Values one = view.trace(near, 256, 21), two = view.trace(near, 256, 22);
    const auto rmse = [&](EntryCheck check) {
      const Values v = buffer.render(scene.light, {.check = check}).visibility;
      return testing::penumbra_error(at_pixels(v, near), one, two).rmse;
    };
    const double with = rmse(EntryCheck::kRays), without = rmse(EntryCheck::kNone);
    std::printf("%-18s RMSE %.4f, entries not checked: %.4f\n", name, with, without);
    EXPECT_LT(with, without) << name;
  }
}

}  // namespace
}  // namespace penumbra
