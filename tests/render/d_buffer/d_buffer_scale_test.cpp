// The D-buffer at any scale and under lights at any distance.
#include <gtest/gtest.h>

#include "tests/render/scale_support.h"

namespace penumbra {
namespace {

TEST(DBufferScale, KeepsItsOwnError) {
  testing::expect_own_error("dbuffer");
}

TEST(DBufferScale, ScenesAreTheSameAtAnyScaleAndPlace) {
  testing::expect_same_at_any_scale("dbuffer", testing::data_scene("boxes-medium"), 0.002);
  testing::expect_same_at_any_scale("dbuffer", testing::regression_scene("sun_distant"), 0.002);
}

TEST(DBufferScale, FarDisksConvergeToTheDistantLight) {
  testing::expect_suns_to_converge("dbuffer", 0.01, 0.004);
}

// A roof of two faces that goes on to nowhere, with one edge in sight: float would lose its place.
TEST(DBufferScale, FacesFarLargerThanTheWindowKeepTheirPlace) {
  for (const double far : {1e2, 1e4, 1e6}) {
    Scene scene;
    scene.lights.push_back({.shape = DiskLight{{-1.0, 6.0, 0.3}, {0.1, -1.0, 0.0}, 0.5}});
    scene.camera = {{2.0, 3.0, 4.0}, {0.2, 0.0, 0.0}, {0, 1, 0}, 50};
    scene.objects.push_back({"floor", make_plane(6.0), Vec3(0.8), false});
    const std::vector<Vec3> roof{{-far, 1.0, -far}, {0.2, 1.0, -far}, {0.2, 1.0, far}, {-far, 1.0, far}};
    scene.objects.push_back({"roof", testing::mesh_of(roof, {{0, 2, 1}, {0, 3, 2}}), Vec3(0.8), true});
    scene.objects.push_back({"box", make_box({0.1, 0.3, 0.2}, Vec3(0.3)), Vec3(0.8), true});
    const testing::FrameError error = testing::error_of(scene, "dbuffer");
    std::printf("a roof %g wide: RMSE %.5f\n", far, error.penumbra);
    EXPECT_LE(error.penumbra, 0.02) << far;
  }
}

}  // namespace
}  // namespace penumbra
