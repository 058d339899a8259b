#include "penumbra/render/scene/camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace penumbra {
namespace {

TEST(Camera, CenterOfTheImageLooksAtTheTarget) {
  const Camera camera{.eye = {3, 2, 5}, .target = {0, 0.5, 0}, .up = {0, 1, 0}, .fov_y_degrees = 50};
  const PixelRays rays(camera, 64, 48);
  EXPECT_EQ(rays.origin, camera.eye);
  const Vec3 forward = glm::normalize(camera.target - camera.eye);
  EXPECT_LT(glm::distance(rays.direction(32, 24), forward), 1e-14);
}

TEST(Camera, TopIsUpAndRightIsRight) {
  const PixelRays rays({.eye = {0, 0, 5}, .target = {0, 0, 0}, .up = {0, 1, 0}, .fov_y_degrees = 90}, 200,
                       100);
  // 90 degrees high, at distance 1: the top is at +1, and the width twice the height.
  EXPECT_LT(glm::distance(rays.direction(0, 0), Vec3(-2, 1, -1)), 1e-14);
  EXPECT_LT(glm::distance(rays.direction(200, 100), Vec3(2, -1, -1)), 1e-14);
}

TEST(Camera, PixelsAreSquareAndTheFieldOfViewIsVertical) {
  const Camera camera{.eye = {1, 2, 3}, .target = {-4, 1, 0}, .up = {0.2, 1, 0.1}, .fov_y_degrees = 33};
  const PixelRays rays(camera, 320, 200);
  const double across = glm::distance(rays.direction(0, 0), rays.direction(1, 0));
  const double down = glm::distance(rays.direction(0, 0), rays.direction(0, 1));
  EXPECT_NEAR(across, down, 1e-15);
  const double height = glm::distance(rays.direction(160, 0), rays.direction(160, 200));
  EXPECT_NEAR(height, 2 * std::tan(33 * std::numbers::pi / 360), 1e-14);
}

TEST(Camera, DirectionsHaveLengthOneAlongTheLineOfSight) {
  const Camera camera{.eye = {1, 2, 3}, .target = {-4, 1, 0}, .up = {0, 0, 1}, .fov_y_degrees = 120};
  const PixelRays rays(camera, 7, 5);
  const Vec3 forward = glm::normalize(camera.target - camera.eye);
  for (double x = 0; x <= 7; x += 0.5) EXPECT_NEAR(glm::dot(rays.direction(x, 1.25), forward), 1.0, 1e-14);
}

TEST(Camera, ScaleOfTheSceneDoesNotMatter) {
  for (const double scale : {1e-180, 1.0, 1e180}) {
    const Camera camera{
        .eye = scale * Vec3(0, 0, 5), .target = Vec3(0), .up = scale * Vec3(0, 1, 0), .fov_y_degrees = 90};
    EXPECT_LT(glm::distance(PixelRays(camera, 2, 2).direction(0, 0), Vec3(-1, 1, -1)), 1e-14) << scale;
  }
}

}  // namespace
}  // namespace penumbra
