// Camera and handles without a window.
#include "apps/viewer/handles/navigation.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "apps/viewer/handles/light_handles.h"

namespace penumbra::viewer {
namespace {

const Camera kCamera{.eye = {3, 4, 5}, .target = {0.2, 0.5, 0.1}, .up = {0, 1, 0}, .fov_y_degrees = 40};

TEST(Projection, InvertsPixelRays) {
  const Projection projection(kCamera, 640, 480);
  const PicturePoint at{123.25, 77.5};
  const auto back = projection.project(projection.eye() + 7.0 * projection.direction(at));
  ASSERT_TRUE(back);
  EXPECT_NEAR(back->x, at.x, 1e-9);
  EXPECT_NEAR(back->y, at.y, 1e-9);
  EXPECT_FALSE(projection.project(projection.eye() - projection.direction(at)));
}

TEST(Navigation, ZoomKeepsThePivotWhereItIs) {
  const Vec3 pivot(0.7, 0.2, -0.4);
  const auto before = Projection(kCamera, 640, 480).project(pivot);
  const auto after = Projection(zoomed(kCamera, pivot, 0.5), 640, 480).project(pivot);
  EXPECT_NEAR(before->x, after->x, 1e-9);
  EXPECT_NEAR(before->y, after->y, 1e-9);
}

TEST(Navigation, TurningKeepsTheDistanceAndStopsBelowThePole) {
  const Camera turned = rotated(kCamera, {0, 1, 0}, 0.3, 10.0);
  EXPECT_NEAR(glm::length(turned.eye - turned.target), glm::length(kCamera.eye - kCamera.target), 1e-12);
  EXPECT_GT(std::hypot(turned.eye.x - turned.target.x, turned.eye.z - turned.target.z), 1e-3);
}

TEST(LightHandles, EachHandleIsFoundWhereItIsSeenAndMovesOnlyItsOwn) {
  const DiskLight light{.center = {0.3, 2, 0.1}, .normal = {0.1, -1, 0.2}, .radius = 0.6};
  const Projection projection(kCamera, 640, 480);
  const HandleShape shape = handle_shape(light, projection);
  const std::pair<Handle, Vec3> places[] = {
      {Handle::kAxisX, shape.axis_tips[0]}, {Handle::kAxisY, shape.axis_tips[1]},
      {Handle::kAxisZ, shape.axis_tips[2]}, {Handle::kNormal, shape.normal_tip},
      {Handle::kRim, shape.rim_knob},       {Handle::kCenter, shape.center}};
  for (const auto& [handle, place] : places) {
    const PicturePoint at = *projection.project(place);
    EXPECT_EQ(pick(shape, projection, at), handle) << name_of(handle);
    const HandleDrag drag(handle, light, projection, at);
    EXPECT_NEAR(glm::length(drag.moved_to(projection, at).disk.center - light.center), 0.0, 1e-9);
    const DiskLight moved = drag.moved_to(projection, {at.x + 13, at.y + 7}).disk;
    EXPECT_EQ(moved.radius != light.radius, handle == Handle::kRim) << name_of(handle);
    EXPECT_EQ(moved.normal != light.normal, handle == Handle::kNormal) << name_of(handle);
    EXPECT_EQ(moved.center == light.center, handle == Handle::kRim || handle == Handle::kNormal)
        << name_of(handle);
    if (handle == Handle::kAxisX) {
      EXPECT_EQ(moved.center.y, light.center.y);
    }
  }
}

}  // namespace
}  // namespace penumbra::viewer
