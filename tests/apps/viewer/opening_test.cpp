// The camera with which a scene opens, and the point that a light keeps shining at.
#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "apps/viewer/handles/aim.h"
#include "apps/viewer/handles/light_handles.h"
#include "apps/viewer/handles/opening_view.h"
#include "tests/apps/viewer/scenes.h"

namespace penumbra::viewer {
namespace {

bool sees(const State& state, const Vec3& p) {
  const auto at = Projection(state.camera, state.left.width, state.left.height).project(p);
  return at && at->x > 0.0 && at->y > 0.0 && at->x < state.left.width && at->y < state.left.height;
}

TEST(OpeningView, ShowsTheLightItsHandlesAndTheCasters) {
  for (const char* name :
       {"meshes/bunny.ply", "meshes/knot1.ply", "meshes/doll-house.ply", "scenes/cube-medium.json",
        "scenes/torus-medium.json", "scenes/boxes-sun.json", "scenes/building.json"}) {
    const Document document = document_of(name);
    const State& state = document.state();
    const HandleShape shape =
        handle_shape(state.handled(), Projection(state.camera, state.left.width, state.left.height));
    for (const Vec3& p : shape.rim) EXPECT_TRUE(sees(state, p)) << name;
    for (const Vec3& p : shape.axis_tips) EXPECT_TRUE(sees(state, p)) << name;
    EXPECT_TRUE(sees(state, shape.normal_tip)) << name;
    EXPECT_TRUE(sees(state, shape.rim_knob)) << name;
    EXPECT_TRUE(sees(state, state.model->caster_bounds().center())) << name;
    // It looks the way the file's camera does.
    const auto way = [](const Camera& c) { return glm::normalize(c.target - c.eye); };
    EXPECT_NEAR(glm::dot(way(state.camera), way(state.model->camera)), 1.0, 1e-9) << name;
  }
}

TEST(OpeningView, IsTheFilesCameraWhereThatShowsTheLightOrIsToBeKept) {
  Document document = document_of("scenes/cube-medium.json");
  const State& state = document.state();
  EXPECT_NE(state.camera, state.model->camera);
  EXPECT_EQ(with_light_in_view(state.camera, *state.model, state.handled(), 640, 480), state.camera);
  const Document kept(data_path("scenes/cube-medium.json"), sized_state(), true);
  EXPECT_EQ(kept.state().camera, kept.state().model->camera);
}

TEST(OpeningView, StaysWhereTheLightIsTooFarAway) {
  Document document = document_of("scenes/cube-medium.json");
  HandledLight light = document.state().handled();
  light.disk.center *= 100.0;
  const Scene& scene = *document.state().model;
  EXPECT_EQ(with_light_in_view(scene.camera, scene, light, 640, 480), scene.camera);
}

Scene plates() {
  const auto plate = [](double y) {
    const std::vector<Vec3> corners{{-1, y, -1}, {1, y, -1}, {1, y, 1}, {-1, y, 1}};
    return TriangleMesh::build(corners, std::vector<IndexedTriangle>{{0, 2, 1}, {0, 3, 2}});
  };
  Scene scene;
  for (const double y : {0.0, 1.0}) scene.objects.push_back({.name = "plate", .mesh = plate(y)});
  return scene;
}

TEST(LitPoint, IsTheFirstOnTheAxis) {
  const auto first = lit_point(plates(), {{0.3, 5, 0.2}, {0, -2, 0}, 0.5});
  ASSERT_TRUE(first);
  EXPECT_NEAR(glm::distance(*first, Vec3(0.3, 1.0, 0.2)), 0.0, 1e-12);
}

TEST(LitPoint, WhereTheAxisMeetsNothingIsNearTheMiddleOrNone) {
  const auto beside = lit_point(plates(), {{3, 5, 0}, {0, -1, 0}, 0.5});
  ASSERT_TRUE(beside);
  EXPECT_NEAR(glm::distance(*beside, Vec3(3, 0.5, 0)), 0.0, 1e-12);
  EXPECT_FALSE(lit_point(plates(), {{3, 5, 0}, {0, 1, 0}, 0.5})) << "everything is behind it";
}

TEST(HandleDrag, TurnsALightToWhatItShoneAt) {
  const Camera camera{.eye = {0, 3, 9}, .target = {0, 3, 0}};
  const Projection projection(camera, 640, 480);
  const HandledLight light = DiskLight{{0, 5, 0}, {0, -1, 0}, 0.5};
  const Vec3 aim(0, 1, 0);
  for (const Handle handle : {Handle::kCenter, Handle::kAxisX}) {
    const PicturePoint start = *projection.project(
        handle == Handle::kCenter ? light.disk.center : handle_shape(light, projection).axis_tips[0]);
    const PicturePoint to{start.x + 60, start.y};
    const HandledLight turned = HandleDrag(handle, light, projection, start, aim).moved_to(projection, to);
    EXPECT_GT(turned.disk.center.x, 0.5);
    EXPECT_NEAR(glm::distance(turned.disk.normal, glm::normalize(aim - turned.disk.center)), 0.0, 1e-12);
    const HandledLight straight = HandleDrag(handle, light, projection, start).moved_to(projection, to);
    EXPECT_EQ(straight.disk.center, turned.disk.center);
    EXPECT_EQ(straight.disk.normal, light.disk.normal);
    EXPECT_EQ(HandleDrag(handle, light, projection, start, aim).moved_to(projection, start).disk.normal,
              light.disk.normal)
        << "no jump at the start";
  }
}

}  // namespace
}  // namespace penumbra::viewer
